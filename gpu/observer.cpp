#include "gpu/observer.h"

#include "base/error.h"
#include "base/words.h"
#include "gpu/counter.h"
#include "techniques/gl/api.h"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

namespace shadowbench::gpu {
namespace {

constexpr Words<MoveKind, 4> moveKinds{"kind of move",
                                       {{{MoveKind::Clear, "clear"},
                                         {MoveKind::Copy, "copy"},
                                         {MoveKind::Mipmap, "mipmap"},
                                         {MoveKind::ReadBack, "read back"}}}};

Observer* living = nullptr;

GLuint bound(GLenum what) {
    GLint found = 0;
    glGetIntegerv(what, &found);
    return static_cast<GLuint>(found);
}

/// What stands before the function that `slot` points to: `observe` sees its arguments first.
template <auto& slot, auto observe, typename Function = std::remove_reference_t<decltype(slot)>>
struct Hook;

template <auto& slot, auto observe, typename... Arguments>
struct Hook<slot, observe, void(APIENTRYP)(Arguments...)> {
    inline static void(APIENTRYP original)(Arguments...) = nullptr;
    static void APIENTRY observed(Arguments... arguments) {
        observe(arguments...);
        original(arguments...);
    }
    static void install() { original = std::exchange(slot, observed); }
    static void remove() { slot = original; }
};

} // namespace

struct Hooks {
    template <typename... Others>
    static void onDraw(GLenum topology, Others... /*others*/) {
        living->draw(topology);
    }
    static void onDispatch(GLuint x, GLuint y, GLuint z) { living->dispatch(x, y, z); }
    static void onBegin(GLenum /*source*/, GLuint /*id*/, GLsizei length, const GLchar* text) {
        living->pass_.assign(text, static_cast<std::size_t>(length));
        living->drawnInto_ = {};
    }
    static void onEnd() {
        living->pass_.clear();
        living->drawnInto_ = {};
    }
    template <typename Values>
    static void onClear(GLenum buffer, GLint drawBuffer, Values /*values*/) {
        living->move(MoveKind::Clear, clearedBy(buffer, drawBuffer));
    }
    static void onCopy(GLuint from, GLenum /*target*/, GLint /*level*/, GLint /*x*/, GLint /*y*/, GLint /*z*/, GLuint /*to*/,
                       GLenum /*target*/, GLint /*level*/, GLint /*x*/, GLint /*y*/, GLint /*z*/, GLsizei width,
                       GLsizei height, GLsizei depth) {
        living->move(MoveKind::Copy, {textureTarget(from).format, width, height * depth});
    }
    static void onMipmap(GLenum target) {
        living->move(MoveKind::Mipmap, textureTarget(bound(target == GL_TEXTURE_2D_ARRAY ? GL_TEXTURE_BINDING_2D_ARRAY
                                                                                         : GL_TEXTURE_BINDING_2D)));
    }
    static void onReadPixels(GLint /*x*/, GLint /*y*/, GLsizei width, GLsizei height, GLenum /*format*/, GLenum /*type*/,
                             void* /*pixels*/) {
        living->move(MoveKind::ReadBack, {0, width, height});
    }
    static void onReadBuffer(GLenum /*target*/, GLintptr /*offset*/, GLsizeiptr size, void* /*data*/) {
        living->move(MoveKind::ReadBack, {0, static_cast<int>(size / 4), 1});
    }

    using Arrays = Hook<glDrawArrays, onDraw<GLint, GLsizei>>;
    using Instanced = Hook<glDrawArraysInstanced, onDraw<GLint, GLsizei, GLsizei>>;
    using InstancedFrom = Hook<glDrawArraysInstancedBaseInstance, onDraw<GLint, GLsizei, GLsizei, GLuint>>;
    using Indirect = Hook<glDrawArraysIndirect, onDraw<const void*>>;
    using Elements = Hook<glDrawElements, onDraw<GLsizei, GLenum, const void*>>;
    using ElementsFrom = Hook<glDrawElementsInstancedBaseInstance, onDraw<GLsizei, GLenum, const void*, GLsizei, GLuint>>;
    using Dispatch = Hook<glDispatchCompute, onDispatch>;
    using ClearFloat = Hook<glClearBufferfv, onClear<const GLfloat*>>;
    using ClearInteger = Hook<glClearBufferiv, onClear<const GLint*>>;
    using ClearUnsigned = Hook<glClearBufferuiv, onClear<const GLuint*>>;
    using Copy = Hook<glCopyImageSubData, onCopy>;
    using Mipmap = Hook<glGenerateMipmap, onMipmap>;
    using ReadPixels = Hook<glReadPixels, onReadPixels>;
    using ReadBuffer = Hook<glGetBufferSubData, onReadBuffer>;
    using Begin = Hook<glPushDebugGroup, onBegin>;
    using End = Hook<glPopDebugGroup, onEnd>;

    template <typename Each>
    static void each(const Each& each) {
        each(Arrays{}), each(Instanced{}), each(InstancedFrom{}), each(Indirect{}), each(Elements{}), each(ElementsFrom{});
        each(Dispatch{}), each(Begin{}), each(End{});
        each(ClearFloat{}), each(ClearInteger{}), each(ClearUnsigned{}), each(Copy{}), each(Mipmap{});
        each(ReadPixels{}), each(ReadBuffer{});
    }
};

Observer::Observer(Counter* counter) : counter_(counter) {
    if (living != nullptr) throw InternalError("a second observer of a frame's pipelines was made beside a living one");
    living = this;
    Hooks::each([](auto hook) { decltype(hook)::install(); });
}

Observer::~Observer() {
    Hooks::each([](auto hook) { decltype(hook)::remove(); });
    living = nullptr;
}

std::vector<Use> Observer::take() {
    if (counter_ != nullptr)
        for (auto& [key, passes] : counter_->take())
            if (const auto known = known_.find(key); known != known_.end()) uses_[known->second].passes = std::move(passes);
    known_.clear();
    return std::exchange(uses_, {});
}

std::vector<Move> Observer::takeMoves() { return std::exchange(moves_, {}); }

void Observer::draw(unsigned topology) {
    Pipeline pipeline{currentShaders(), drawState(topology)};
    const std::string key = keyOf(pipeline);
    if (counter_ != nullptr) counter_->draw(key);
    Use& use = note(std::move(pipeline), key);
    const DrawnInto into{bound(GL_DRAW_FRAMEBUFFER_BINDING), viewport()};
    if (into != drawnInto_) ++use.extents[into.second];
    drawnInto_ = into;
}

void Observer::dispatch(unsigned x, unsigned y, unsigned z) {
    std::array<GLint, 3> group{};
    glGetProgramiv(bound(GL_CURRENT_PROGRAM), GL_COMPUTE_WORK_GROUP_SIZE, group.data());
    Pipeline pipeline{currentShaders(), {}};
    const std::string key = keyOf(pipeline);
    const int invocations = group[0] * group[1] * group[2];
    if (counter_ != nullptr) counter_->dispatch(key, {x, y, z}, static_cast<unsigned>(invocations));
    Use& use = note(std::move(pipeline), key);
    ++use.extents[{static_cast<int>(x) * group[0], static_cast<int>(y * z) * group[1] * group[2]}];
}

std::string Observer::keyOf(const Pipeline& pipeline) const { return pass_ + "\n" + pipeline.digest(); }

Use& Observer::note(Pipeline pipeline, const std::string& key) {
    const auto [entry, isNew] = known_.try_emplace(key, uses_.size());
    if (isNew) uses_.push_back({pass_, std::move(pipeline)});
    Use& use = uses_[entry->second];
    ++use.draws;
    return use;
}

void Observer::move(MoveKind kind, const Target& target) {
    auto found = std::ranges::find_if(
        moves_, [&](const Move& move) { return move.pass == pass_ && move.kind == kind && move.format == target.format; });
    if (found == moves_.end()) found = moves_.insert(found, {pass_, kind, target.format});
    ++found->extents[{target.width, target.height}];
}

std::string_view name(MoveKind kind) { return moveKinds.of(kind); }
MoveKind moveNamed(std::string_view word) { return moveKinds.named(word); }

} // namespace shadowbench::gpu
