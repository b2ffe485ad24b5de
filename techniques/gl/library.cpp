#include "techniques/gl/library.h"

#include "base/error.h"

#include <cstdlib>
#include <dlfcn.h>

namespace shadowbench::gl {

Library::Library(const std::string& name, const char* variable) : name_(name) {
    if (const char* other = std::getenv(variable)) name_ = other;
    handle_ = dlopen(name_.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ != nullptr) return;
    const char* reason = dlerror();
    whyNot_ = reason != nullptr ? reason : name_ + " does not open";
}

void* Library::address(const char* name) const {
    void* found = dlsym(handle_, name);
    if (found == nullptr) throw Inconclusive(name_ + " has no function " + name + ": it is another library or too old");
    return found;
}

} // namespace shadowbench::gl
