// The switch in a program that holds many mutants: one of them, or none, is on for as long as it runs.
#pragma once

#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>

namespace mutants {

constexpr int most = 4096; // numbers of mutants are below it

struct Switch {
    int chosen = 0;
    unsigned char* reached = nullptr;
};

/// The mutant that MUTANT names is on. MUTANTS_REACHED names a file of `most` bytes, in which each mutant that is asked for
/// leaves its mark at once: also in a child process, and in one that is killed.
inline Switch readSwitch() {
    Switch result;
    if (const char* number = std::getenv("MUTANT")) result.chosen = std::atoi(number);
    const char* marks = std::getenv("MUTANTS_REACHED");
    const int file = marks == nullptr ? -1 : open(marks, O_RDWR | O_CLOEXEC);
    if (file < 0) return result;
    void* memory = mmap(nullptr, most, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (memory != MAP_FAILED) result.reached = static_cast<unsigned char*>(memory);
    return result;
}

inline bool active(int number) {
    static const Switch state = readSwitch();
    if (state.reached != nullptr) state.reached[number] = 1;
    return state.chosen == number;
}

} // namespace mutants
