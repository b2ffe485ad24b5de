// Files of other people are read in a child that has no more than it needs (docs/threat-model.md). The child is this
// program, started anew, so that it has nothing of what the parent has in memory or open; it is given open files and a
// socket, gives up everything else (base/confined/confinement.h), reads, and answers in numbers, texts and arrays that are
// checked one by one.
//
// A kind of reader is an object with static storage in the file that asks it:
//
//     void readSum(ForeignWork& work) { work.answer().put(sumOf(contentOf(work.files().front()))); }
//     const ForeignReader sums("sum", readSum);
//     ReaderChild child(sums, "cannot add up x.txt", {openRegular("x.txt")});
//     child.awaitAnswer();
//     const std::uint64_t sum = child.number(1000, "as a sum");
//
// Whoever tests or fuzzes a library itself calls what the child calls: readMeshHere() and readPartsHere()
// (scene/meshes/foreign_mesh.h), DecodedImage (base/confined/decoded_image.h).
#pragma once

#include "base/confined/confinement.h"
#include "base/confined/opened_files.h"
#include "base/confined/wire.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shadowbench {

/// What the child has to do, as the reader sees it.
class ForeignWork {
public:
    ForeignWork(std::string request, std::vector<OpenedFile> files, Wire& wire);

    [[nodiscard]] const std::string& request() const { return request_; }
    [[nodiscard]] const std::vector<OpenedFile>& files() const { return files_; }

    /// Begins an answer, once all that can fail is done: what follows is sent as it is put. Until then a reader throws
    /// BadInput with a sentence about the file, without its name.
    Wire& answer();
    /// Waits for a number that the parent puts, less than `end`; none when it asks no more.
    std::optional<std::uint64_t> question(std::uint64_t end);

private:
    std::string request_;
    std::vector<OpenedFile> files_;
    Wire& wire_;
};

class ForeignReader {
public:
    using Read = void (*)(ForeignWork& work);

    /// Where this process was started as a child of that name it reads, and never returns: that is how every program which
    /// links a reader can be its own child, tests among them. `name` must live as long as the program.
    ForeignReader(const char* name, Read read) noexcept;

    [[nodiscard]] const char* name() const { return name_; }

private:
    const char* name_;
};

/// A child that reads one file, and is killed when the object goes. Every function throws BadInput, one line that begins
/// with `doing` ("cannot import mesh x.ply"), when the file is refused, when the child dies, hangs or takes more than it
/// may, and when its answer is none; Inconclusive when it cannot be started or the user interrupts.
class ReaderChild {
public:
    ReaderChild(const ForeignReader& reader, std::string doing, std::vector<OpenedFile> files,
                const std::string& request = "");
    /// In place of a child, what one might have said: for those who test what becomes of a hostile answer.
    ReaderChild(std::string doing, Descriptor answer);
    ~ReaderChild();
    ReaderChild(const ReaderChild&) = delete;
    ReaderChild& operator=(const ReaderChild&) = delete;

    /// What holds it.
    [[nodiscard]] const Protections& protections() const;

    /// Puts a question to a reader that waits for one.
    void ask(std::uint64_t question);

    /// Waits until an answer begins.
    void awaitAnswer();
    // Parts of it:
    std::uint64_t number(std::uint64_t most, const char* meaning);
    std::string text(std::size_t longest); // without control characters
    template <typename T>
    void fill(std::span<T> array) {
        receive([&](Wire& wire) { wire.fill(array); });
    }

    /// Of an answer that breaks a rule of its own.
    [[noreturn]] void refuse(const std::string& sentence) const;

private:
    struct Running;
    void receive(const std::function<void(Wire&)>& part);

    std::string doing_;
    std::unique_ptr<Running> running_;
};

/// What protects this system from a reader, tried out with a child.
Protections protectionsHere();

} // namespace shadowbench
