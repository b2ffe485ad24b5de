// To be preloaded: of the allocations (operator new) that the program's own code makes, in all processes that it forks, the
// one fails that the plan wants (base/faults.h). Allocations of libraries are no concern of it; std::string's and its like,
// which the standard library makes for our code, are ours. The other forms of new end in this one.
#include "base/faults.h"

#include <cstdlib>
#include <dlfcn.h>
#include <new>
#include <sys/auxv.h>
#include <unwind.h>

namespace {

namespace faults = shadowbench::faults;

/// Where the file of a code's address is loaded.
void* baseOf(void* address) {
    Dl_info info{};
    return dladdr(address, &info) != 0 ? info.dli_fbase : nullptr;
}

// NOLINTBEGIN(performance-no-int-to-ptr): addresses of code
void* const program = baseOf(reinterpret_cast<void*>(getauxval(AT_PHDR)));
void* const library = baseOf(reinterpret_cast<void*>(&std::get_new_handler)); // the standard one

/// Leaves the standard library's frames and ours behind: who has called it?
_Unwind_Reason_Code look(_Unwind_Context* context, void* caller) {
    static void* const here = baseOf(reinterpret_cast<void*>(&look));
    void* base = baseOf(reinterpret_cast<void*>(_Unwind_GetIP(context)));
    if (base == library || base == here) return _URC_NO_REASON;
    *static_cast<void**>(caller) = base;
    return _URC_END_OF_STACK;
}
// NOLINTEND(performance-no-int-to-ptr)

bool fails(void* address) {
    if (faults::activePlan == nullptr || program == nullptr || library == nullptr) return false;
    void* caller = baseOf(address);
    if (caller == library) _Unwind_Backtrace(look, &caller);
    return caller == program && ++faults::activePlan->counts.back() == faults::activePlan->wanted.number;
}

} // namespace

void* operator new(std::size_t bytes) {
    void* memory = fails(__builtin_return_address(0)) ? nullptr : std::malloc(bytes == 0 ? 1 : bytes);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
