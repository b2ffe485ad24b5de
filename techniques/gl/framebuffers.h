// Framebuffer objects, kept from frame to frame: one for each list of textures that is drawn into.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <tuple>

namespace shadowbench::gl {

/// What a framebuffer draws into: GL names of textures, in order, and of an array which layer.
struct Attachments {
    std::array<unsigned, 8> textures{}; // 0: no more
    int layer = 0;
    friend bool operator<(const Attachments& a, const Attachments& b) {
        return std::tie(a.textures, a.layer) < std::tie(b.textures, b.layer);
    }
};

/// Made once, so that a frame that draws into the textures of the one before makes no framebuffer.
class Framebuffers {
public:
    /// The framebuffer over `attachments`: made by `make` when it is asked for first.
    unsigned over(const Attachments& attachments, const std::function<unsigned()>& make);

    /// Deletes all that draw into `texture`, whose name GL may give to another one.
    void forget(unsigned texture);

private:
    std::map<Attachments, unsigned> framebuffers_;
};

} // namespace shadowbench::gl
