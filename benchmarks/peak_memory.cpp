#include "benchmarks/peak_memory.h"

#include "base/error.h"

#include <exception>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shadowbench::benchmarks {

std::size_t peakMemory(const std::function<void()>& work) {
    const pid_t child = fork();
    if (child < 0) throw InternalError("A process to measure memory in could not be started.");
    if (child == 0) {
        try {
            work();
        } catch (const std::exception&) {
            _exit(1);
        }
        _exit(0);
    }
    int status = 0;
    rusage usage{};
    if (wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw InternalError("The process to measure memory in failed.");
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

} // namespace shadowbench::benchmarks
