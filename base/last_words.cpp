#include "base/last_words.h"

#include "base/error.h"
#include "base/live_files.h"

#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace shadowbench {
namespace {

// A signal handler can reach nothing but statics.
pid_t speaker = 0;

/// Without allocating: there may be no memory, or a library may hold the allocator's lock.
void say(std::string_view words) {
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, words.data(), words.size());
}

void sayError(const std::exception& error) {
    say("shadowbench: internal error: ");
    say(error.what());
    say("\n");
}

[[noreturn]] void end() {
    removeLiveFiles();
    _exit(static_cast<int>(ExitCode::Internal));
}

void onAbort(int /*signal*/) {
    if (getpid() != speaker) return; // abort() then ends the process by the signal
    say("shadowbench: internal error: a library aborted the program; the files that it has written are whole: run it again, "
        "with --resume where there is one\n");
    end();
}

void onTerminate() {
    if (getpid() != speaker) std::abort();
    try {
        if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
        say("shadowbench: there is not enough memory; free some, or use --jobs 1 where there is one\n");
        end();
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again)
            say("shadowbench: a thread could not be started; allow more (ulimit -u) or free memory\n");
        else
            sayError(error);
        end();
    } catch (const std::exception& error) {
        sayError(error);
        end();
    } catch (...) { // of a library
    }
    std::abort();
}

} // namespace

void sayWhyAborted() {
    speaker = getpid();
    std::set_terminate(onTerminate);
    struct sigaction action {};
    action.sa_handler = onAbort;
    sigemptyset(&action.sa_mask);
    sigaction(SIGABRT, &action, nullptr);
}

} // namespace shadowbench
