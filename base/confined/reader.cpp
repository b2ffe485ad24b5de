// The child's half: what happens before main() in a process that was started to read a file.
#include "base/confined/reader.h"

#include "base/confined/handshake.h"
#include "base/confined/reader_server.h"
#include "base/error.h"
#include "base/limits.h"

#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <new>
#include <unistd.h>

namespace shadowbench {
namespace {

constexpr int theSocket = 0;
constexpr std::size_t longestRequest = 4096;

/// What the parent's limits were when it started us: a child has no variable of its own for them.
void takeLimits(Wire& wire) {
    for (const LimitEntry& limit : limits()) {
        const std::string number = std::to_string(wire.number(limit.most, "as a limit"));
        ::setenv(std::string(limit.variable).c_str(), number.c_str(), 1);
    }
}

/// What the reader throws becomes a refusal, in place of the answer that it has not begun.
void readAndAnswer(ForeignReader::Read read, ForeignWork& work, Wire& wire) {
    std::string why;
    try {
        return read(work);
    } catch (const std::bad_alloc&) {
        why = fmt::format("reading it takes more memory than the {} MiB of {}, which can be raised",
                          limitOf(Limit::ReaderMib), variableOf(Limit::ReaderMib));
    } catch (const std::exception& error) {
        why = error.what();
    }
    handshake::begin(wire, handshake::Status::Refused);
    wire.put(std::string_view(why).substr(0, handshake::longestRefusal));
}

void serve(ForeignReader::Read read) {
    ::close_range(theSocket + 3, ~0U, 0);
    Wire wire{Descriptor(theSocket)};
    try {
        const std::uint64_t seconds = wire.number(handshake::mostSeconds, "seconds");
        takeLimits(wire);
        std::string request = wire.text(longestRequest);
        ForeignWork work(std::move(request), wire.takeHanded(), wire);
        handshake::announce(wire, confineThisProcess(theSocket, limitOf(Limit::ReaderMib) << 20U, seconds));
        readAndAnswer(read, work, wire);
    } catch (const WireError&) {
        _exit(1); // the parent has gone
    }
    _exit(0); // without what a program does at its end: nothing of it has begun
}

} // namespace

ForeignWork::ForeignWork(std::string request, std::vector<OpenedFile> files, Wire& wire)
    : request_(std::move(request)), files_(std::move(files)), wire_(wire) {}

Wire& ForeignWork::answer() {
    handshake::begin(wire_, handshake::Status::Answers);
    return wire_;
}

std::optional<std::uint64_t> ForeignWork::question(std::uint64_t end) {
    try {
        const std::uint64_t asked = wire_.number(~std::uint64_t{0}, "as a question");
        if (asked >= end) throw BadInput("the question is out of range");
        return asked;
    } catch (const WireError&) {
        return std::nullopt;
    }
}

ForeignReader::ForeignReader(const char* name, Read read) noexcept : name_(name) {
    const char* wanted = std::getenv(handshake::variable);
    if (wanted != nullptr && std::strcmp(wanted, name) == 0) serveFiles([read] { serve(read); });
}

} // namespace shadowbench
