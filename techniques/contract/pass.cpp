#include "techniques/contract/pass.h"

#include "techniques/gl/api.h"

namespace shadowbench::techniques {

Pass::Pass(std::string_view name, PassListener* listener) : name_(name), listener_(listener) {
    if (listener_ != nullptr) listener_->begin(name_);
    glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name_.size()), name_.data());
}

Pass::~Pass() {
    glPopDebugGroup();
    if (listener_ != nullptr) listener_->end(name_);
}

} // namespace shadowbench::techniques
