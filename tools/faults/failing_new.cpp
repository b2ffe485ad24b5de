// To be preloaded: of the allocations (operator new) that the program's own code makes, in all processes that it forks, the
// one whose number is in SHADOWBENCH_FAIL_NEW fails. How many there were is counted in the file SHADOWBENCH_NEW_COUNT, of at
// least eight bytes. Allocations of libraries are no concern of it; std::string's and its like, which the standard library
// makes for our code, are ours.
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <link.h>
#include <new>
#include <sys/mman.h>
#include <unistd.h>
#include <unwind.h>

namespace {

/// The code of one loaded file.
struct Code {
    std::uintptr_t begin = 0, end = 0;
    [[nodiscard]] bool has(std::uintptr_t address) const { return address >= begin && address < end; }
};

Code program, library;          // ours, and the standard library
std::uint64_t* count = nullptr; // shared with forked processes
std::uint64_t failing = 0;

int noteCode(dl_phdr_info* info, std::size_t /*size*/, void* /*data*/) {
    Code* code = nullptr;
    if (program.end == 0)
        code = &program; // the program comes first
    else if (std::strstr(info->dlpi_name, "libstdc++.so") != nullptr)
        code = &library;
    if (code == nullptr) return 0;
    for (int i = 0; i < info->dlpi_phnum; ++i) {
        const ElfW(Phdr)& part = info->dlpi_phdr[i];
        if (part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0)
            *code = {info->dlpi_addr + part.p_vaddr, info->dlpi_addr + part.p_vaddr + part.p_memsz};
    }
    return 0;
}

__attribute__((constructor(101))) void start() {
    const char *number = std::getenv("SHADOWBENCH_FAIL_NEW"), *file = std::getenv("SHADOWBENCH_NEW_COUNT");
    if (number == nullptr || file == nullptr) return;
    dl_iterate_phdr(noteCode, nullptr);
    const int descriptor = open(file, O_RDWR | O_CLOEXEC);
    if (descriptor < 0) return;
    void* memory = mmap(nullptr, sizeof *count, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    close(descriptor);
    failing = std::strtoull(number, nullptr, 10);
    if (memory != MAP_FAILED) count = static_cast<std::uint64_t*>(memory);
}

struct Walk {
    bool inLibrary = false, ours = false;
    int frames = 0;
};

/// Leaves the standard library's frames behind: who has called it?
_Unwind_Reason_Code look(_Unwind_Context* context, void* data) {
    Walk& walk = *static_cast<Walk*>(data);
    constexpr int mostFrames = 16;
    const std::uintptr_t address = _Unwind_GetIP(context);
    if (library.has(address)) {
        walk.inLibrary = true;
    } else if (walk.inLibrary) {
        walk.ours = program.has(address);
        return _URC_END_OF_STACK;
    }
    return ++walk.frames < mostFrames ? _URC_NO_REASON : _URC_END_OF_STACK;
}

bool isOurs(std::uintptr_t caller) {
    if (program.has(caller)) return true;
    if (!library.has(caller)) return false;
    Walk walk;
    _Unwind_Backtrace(look, &walk);
    return walk.ours;
}

bool fails(void* caller) {
    if (count == nullptr || !isOurs(reinterpret_cast<std::uintptr_t>(caller))) return false; // NOLINT: an address of code
    return std::atomic_ref(*count).fetch_add(1) + 1 == failing;
}

void* allocate(std::size_t bytes, void* caller) { return fails(caller) ? nullptr : std::malloc(bytes == 0 ? 1 : bytes); }

void* allocate(std::size_t bytes, std::align_val_t alignment, void* caller) {
    const auto unit = static_cast<std::size_t>(alignment);
    return fails(caller) ? nullptr : std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
}

void* required(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

} // namespace

// The caller's address is known only in the function that it calls.
void* operator new(std::size_t bytes) { return required(allocate(bytes, __builtin_return_address(0))); }
void* operator new[](std::size_t bytes) { return required(allocate(bytes, __builtin_return_address(0))); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    return allocate(bytes, __builtin_return_address(0));
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
    return allocate(bytes, __builtin_return_address(0));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    return required(allocate(bytes, alignment, __builtin_return_address(0)));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
    return required(allocate(bytes, alignment, __builtin_return_address(0)));
}
