#include "techniques/gl/framebuffers.h"

#include "techniques/gl/api.h"

#include <algorithm>

namespace shadowbench::gl {

unsigned Framebuffers::over(const Attachments& attachments, const std::function<unsigned()>& make) {
    const auto known = framebuffers_.find(attachments);
    if (known != framebuffers_.end()) return known->second;
    const unsigned made = make();
    framebuffers_.emplace(attachments, made);
    return made;
}

void Framebuffers::forget(unsigned texture) {
    std::erase_if(framebuffers_, [&](const auto& entry) {
        const auto& [attachments, framebuffer] = entry;
        if (std::ranges::find(attachments.textures, texture) == attachments.textures.end()) return false;
        glDeleteFramebuffers(1, &framebuffer);
        return true;
    });
}

} // namespace shadowbench::gl
