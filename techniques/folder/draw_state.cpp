#include "techniques/folder/draw_state.h"

#include "base/error.h"
#include "techniques/gl/api.h"

namespace shadowbench::techniques {
namespace {

GLenum glNameOf(StencilOperation operation) {
    switch (operation) {
    case StencilOperation::Keep:
        return GL_KEEP;
    case StencilOperation::Replace:
        return GL_REPLACE;
    case StencilOperation::Increment:
        return GL_INCR_WRAP;
    case StencilOperation::Decrement:
        return GL_DECR_WRAP;
    case StencilOperation::Invert:
        return GL_INVERT;
    }
    throw InternalError("unknown stencil operation");
}

GLenum glNameOf(StencilTest test) {
    if (test == StencilTest::Always) return GL_ALWAYS;
    return test == StencilTest::Equal ? GL_EQUAL : GL_NOTEQUAL;
}

void setBlend(Blend blend) {
    glEnable(GL_BLEND);
    glBlendFunc(blend == Blend::Multiply ? GL_DST_COLOR : GL_ONE, blend == Blend::Multiply ? GL_ZERO : GL_ONE);
    glBlendEquation(blend == Blend::Min ? GL_MIN : blend == Blend::Max ? GL_MAX : GL_FUNC_ADD);
}

void setStencil(const FolderStencil& stencil) {
    glEnable(GL_STENCIL_TEST);
    glStencilMask(0xFF);
    glStencilFunc(glNameOf(stencil.test), stencil.reference, 0xFF);
    glStencilOp(glNameOf(stencil.fail), glNameOf(stencil.depthFail), glNameOf(stencil.pass));
}

} // namespace

DrawState::DrawState(const FolderPass& pass)
    : blends_(pass.blend.has_value()), culls_(pass.cull != Cull::None), peels_(pass.peels),
      hasStencil_(pass.stencil.has_value()) {
    if (blends_) setBlend(*pass.blend);
    if (hasStencil_) setStencil(*pass.stencil);
    if (!pass.depthTest) glDisable(GL_DEPTH_TEST); // until the next pass sets it
    if (culls_) {
        glEnable(GL_CULL_FACE);
        glCullFace(pass.cull == Cull::Front ? GL_FRONT : GL_BACK);
    }
    if (peels_) {
        glDepthFunc(GL_GREATER);
        glDepthMask(GL_FALSE);
    }
}

DrawState::~DrawState() {
    if (blends_) {
        glBlendEquation(GL_FUNC_ADD);
        glDisable(GL_BLEND);
    }
    if (hasStencil_) glDisable(GL_STENCIL_TEST);
    if (culls_) {
        glCullFace(GL_BACK);
        glDisable(GL_CULL_FACE);
    }
    if (peels_) {
        glDepthMask(GL_TRUE);
        glDepthFunc(GL_LESS);
    }
}

} // namespace shadowbench::techniques
