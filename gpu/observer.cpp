#include "gpu/observer.h"

#include "base/error.h"
#include "gpu/state.h"
#include "techniques/gl/api.h"

#include <type_traits>
#include <utility>

namespace shadowbench::gpu {
namespace {

Observer* living = nullptr;

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
    static void onDispatch(GLuint /*x*/, GLuint /*y*/, GLuint /*z*/) { living->dispatch(); }
    static void onBegin(GLenum /*source*/, GLuint /*id*/, GLsizei length, const GLchar* text) {
        living->pass_.assign(text, static_cast<std::size_t>(length));
    }
    static void onEnd() { living->pass_.clear(); }

    using Arrays = Hook<glDrawArrays, onDraw<GLint, GLsizei>>;
    using Instanced = Hook<glDrawArraysInstanced, onDraw<GLint, GLsizei, GLsizei>>;
    using InstancedFrom = Hook<glDrawArraysInstancedBaseInstance, onDraw<GLint, GLsizei, GLsizei, GLuint>>;
    using Indirect = Hook<glDrawArraysIndirect, onDraw<const void*>>;
    using Elements = Hook<glDrawElements, onDraw<GLsizei, GLenum, const void*>>;
    using ElementsFrom = Hook<glDrawElementsInstancedBaseInstance, onDraw<GLsizei, GLenum, const void*, GLsizei, GLuint>>;
    using Dispatch = Hook<glDispatchCompute, onDispatch>;
    using Begin = Hook<glPushDebugGroup, onBegin>;
    using End = Hook<glPopDebugGroup, onEnd>;

    template <typename Each>
    static void each(const Each& each) {
        each(Arrays{}), each(Instanced{}), each(InstancedFrom{}), each(Indirect{}), each(Elements{}), each(ElementsFrom{});
        each(Dispatch{}), each(Begin{}), each(End{});
    }
};

Observer::Observer() {
    if (living != nullptr) throw InternalError("a second observer of a frame's pipelines was made beside a living one");
    living = this;
    Hooks::each([](auto hook) { decltype(hook)::install(); });
}

Observer::~Observer() {
    Hooks::each([](auto hook) { decltype(hook)::remove(); });
    living = nullptr;
}

std::vector<Use> Observer::take() {
    known_.clear();
    return std::exchange(uses_, {});
}

void Observer::draw(unsigned topology) { note({currentShaders(), drawState(topology)}); }

void Observer::dispatch() { note({currentShaders(), {}}); }

void Observer::note(Pipeline pipeline) {
    const auto [entry, isNew] = known_.try_emplace(pass_ + "\n" + pipeline.digest(), uses_.size());
    if (isNew) uses_.push_back({pass_, std::move(pipeline)});
    ++uses_[entry->second].draws;
}

} // namespace shadowbench::gpu
