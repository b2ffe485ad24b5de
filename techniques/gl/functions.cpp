#include "techniques/gl/functions.h"

#include "base/error.h"
#include "techniques/gl/api.h"

namespace shadowbench {

#define GL_FUNCTION(name) decltype(&::name) name = nullptr;
#include "techniques/gl/functions.inc"
#undef GL_FUNCTION

namespace gl {
namespace {

void* required(const std::string& library, const char* name, void* found) {
    if (found == nullptr) throw Inconclusive(library + " has no function " + name + ": it is older than OpenGL 4.5");
    return found;
}

} // namespace

void loadFunctions(const std::string& library, const std::function<void*(const char* name)>& find) {
#define GL_FUNCTION(name) shadowbench::name = reinterpret_cast<decltype(&::name)>(required(library, #name, find(#name)));
#include "techniques/gl/functions.inc"
#undef GL_FUNCTION
}

} // namespace gl
} // namespace shadowbench
