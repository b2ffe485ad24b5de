// A folder in which verbs of the program are run, disturbed, and run again: everything they need is there before, and what
// they leave is checked.
#pragma once

#include "base/faults.h"
#include "base/temporary_folder.h"

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <sys/mman.h>
#include <vector>

namespace shadowbench::faults {

using Texts = std::vector<std::string>;

/// A verb with its command line, which starts in the sandbox's folder and names its output last.
struct Verb {
    std::string name, words; // words: separated by spaces
    [[nodiscard]] std::string out() const { return words.substr(words.rfind(' ') + 1) + "/"; }
};

/// The verbs that write, on a scene of a few pixels: those with these names; all for none.
std::vector<Verb> verbsNamed(const Texts& names);

/// A fault point that the program has come to (base/faults.h); of a relative path, from the sandbox's folder.
struct Passed {
    std::string point, path, from;
    bool isWanted = false; // it failed, or a signal was sent
};

struct Ended {
    int code = 0;       // or 128 + signal; −1: it was killed after its limit
    std::string text{}; // that it printed
    int strays = 0;     // processes that outlived it, and were killed
    Counts counts{};
    std::vector<Passed> passed{}; // all points but allocations
};

/// What is in files, by their paths: of records, the lines without what differs from one measurement of a cell to the next,
/// sorted; of others, how many lines they have.
using Files = std::map<std::string, Texts>;

class Sandbox {
public:
    /// Makes what the verbs need by `program`; `verbs` are run once, undisturbed, which says what they should leave. Throws
    /// InternalError naming a verb that fails undisturbed.
    Sandbox(std::filesystem::path program, const std::vector<Verb>& verbs);

    [[nodiscard]] const std::filesystem::path& folder() const { return work_; }

    /// Runs a verb where none has been run before, with its fault points counted, and with the disturbance that is wanted;
    /// until all processes that it has started have ended. This process becomes the parent of orphans, and should have no
    /// other children.
    Ended disturbed(const Verb& verb, const Wanted& wanted);
    /// Runs a command line as a user does; as many as one likes at a time.
    [[nodiscard]] Ended run(const std::string& words, const Texts& variables = {}) const;

    [[nodiscard]] Files files() const;
    /// What was there before any verb.
    [[nodiscard]] const Files& before() const { return before_; }
    /// Temporary files and folders that are left, a sentence each.
    [[nodiscard]] Texts leftovers() const;
    /// Partial files, and records that were there before and are lost, a sentence each.
    [[nodiscard]] Texts damage() const;
    /// Why what the verb left is not what it leaves undisturbed; nothing if it is.
    [[nodiscard]] std::optional<std::string> difference(const Verb& verb) const;
    /// A text without the sandbox's own path.
    [[nodiscard]] std::string shown(std::string text) const;

    std::chrono::milliseconds patience{20'000}; // for what a verb has started to end after it

private:
    void reset() const;

    struct Unmap {
        void operator()(Plan* plan) const { munmap(plan, sizeof(Plan)); }
    };
    std::filesystem::path program_;
    TemporaryFolder folder_;
    std::filesystem::path work_, kept_; // the second: a copy of what is there before any verb is run
    std::unique_ptr<Plan, Unmap> plan_;
    Files before_;
    std::map<std::string, Files> expected_; // by verb
};

} // namespace shadowbench::faults
