#include "techniques/gl/context.h"

#include "base/error.h"
#include "techniques/gl/api.h"

namespace shadowbench::gl {
namespace {

// GL's own notion of "current" is per thread and hidden; this is the same thing, visible.
thread_local Context* currentContext = nullptr;

} // namespace

void noteMessage(Context& context, unsigned type, const char* message) {
    if (type == GL_DEBUG_TYPE_ERROR && context.firstError_.empty()) context.firstError_ = message;
}

namespace {

void APIENTRY onMessage(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum /*severity*/, GLsizei /*length*/,
                        const GLchar* message, const void* context) {
    noteMessage(*static_cast<Context*>(const_cast<void*>(context)), type, message);
}

std::string text(GLenum what) { return reinterpret_cast<const char*>(glGetString(what)); }

} // namespace

Context& Context::current() {
    if (currentContext == nullptr) throw InternalError("no OpenGL context is current on this thread");
    return *currentContext;
}

void Context::becomeCurrent(bool debug) {
    currentContext = this;
    info_.renderer = text(GL_RENDERER);
    info_.version = text(GL_VERSION);
    if (!debug) return;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onMessage, this);
}

void Context::ceaseCurrent() { currentContext = nullptr; }

unsigned Context::noAttributes() {
    if (noAttributes_ == 0) glGenVertexArrays(1, &noAttributes_);
    return noAttributes_;
}

void Context::finish() { glFinish(); }

void Context::discardErrors() {
    glGetError();
    firstError_.clear();
}

void Context::check(const std::string& doing) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR && firstError_.empty()) return;
    const std::string reason = firstError_.empty() ? "GL error " + std::to_string(error) : firstError_;
    firstError_.clear();
    throw InternalError(doing + ": " + reason);
}

} // namespace shadowbench::gl
