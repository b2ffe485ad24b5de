#include "gpu/counter.h"

#include "base/error.h"
#include "gpu/marks.h"
#include "techniques/gl/api.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <utility>
#include <vector>

namespace shadowbench::gpu {
namespace {

/// Of the counts of one target: more than the images of all scenes need, less than llvmpipe has for a buffer. Of larger
/// targets some bands are counted.
constexpr std::size_t mostWords = std::size_t{1} << 24;
constexpr std::size_t headerWords = 4, rowsOfBand = 8, invocationsOfBand = 1024;

GLint number(GLenum what) {
    GLint found = 0;
    glGetIntegerv(what, &found);
    return found;
}

struct Source {
    std::string text; // as it was given
    unsigned marks = 1;
};

/// What the marks of the draws since it was begun write.
struct Pending {
    std::string key;
    unsigned marks = 1;
    std::size_t width = 0, height = 0; // of a draw
    std::size_t group = 0;             // of a dispatch
    GLint framebuffer = 0;
    std::size_t words = 0;

    bool operator==(const Pending&) const = default;
};

Counter* living = nullptr;

} // namespace

struct Counter::State {
    // The functions as they were before anything stood before them: what is counted is no work of the frame.
    decltype(glShaderSource) shaderSource = glShaderSource;
    decltype(glGetShaderSource) getShaderSource = glGetShaderSource;
    decltype(glGetShaderiv) getShader = glGetShaderiv;
    decltype(glGetBufferSubData) readBuffer = glGetBufferSubData;

    std::map<GLuint, Source> sources; // of shaders, by OpenGL's names
    GLuint buffer = 0, binding = 0;
    std::optional<Pending> pending;
    std::map<std::string, WavePasses> passes;

    [[nodiscard]] Stage stageOf(GLuint shader) const {
        GLint kind = 0;
        getShader(shader, GL_SHADER_TYPE, &kind);
        return kind == GL_FRAGMENT_SHADER ? Stage::Fragment : kind == GL_COMPUTE_SHADER ? Stage::Compute : Stage::Vertex;
    }

    void give(GLuint shader, const std::string& text) {
        Source& source = sources[shader] = {text, 1};
        std::string given = text;
        const Stage stage = stageOf(shader);
        if (stage != Stage::Vertex) {
            const Marked with = marked({stage, "a shader", text});
            source.marks = with.marks;
            if (with.marks > 1) given = countingText(with, stage, binding);
        }
        const char* pointer = given.c_str();
        shaderSource(shader, 1, &pointer, nullptr);
    }

    /// Of the program in use: more than one where it counts.
    [[nodiscard]] unsigned marksInUse() const {
        std::array<GLuint, 8> ids{};
        GLsizei count = 0;
        glGetAttachedShaders(static_cast<GLuint>(number(GL_CURRENT_PROGRAM)), ids.size(), &count, ids.data());
        unsigned marks = 1;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            if (const auto found = sources.find(ids.at(i)); found != sources.end())
                marks = std::max(marks, found->second.marks);
        return marks;
    }

    void begin(Pending next, bool mayGoOn) {
        if (next.marks == 1) return;
        const std::size_t lanes = next.group == 0 ? next.width * next.height : next.words;
        const std::size_t band = next.group == 0 ? rowsOfBand * next.width : invocationsOfBand;
        const std::size_t bands = (lanes + band - 1) / band;
        const std::size_t every = (bands * band * next.marks + mostWords - 1) / mostWords;
        const std::size_t kept = (bands + every - 1) / every;
        next.height = kept * rowsOfBand;
        next.words = next.group == 0 ? kept * band * next.marks : std::min(lanes, kept * band) * next.marks;
        if (mayGoOn && pending == next) return;
        collect();
        std::vector<GLuint> zeros(headerWords + next.words + band * next.marks, 0);
        zeros[0] = static_cast<GLuint>(next.width);
        zeros[1] = static_cast<GLuint>(band);
        zeros[2] = static_cast<GLuint>(every);
        fill(zeros);
        pending = std::move(next);
    }

    void fill(const std::vector<GLuint>& words) {
        const auto before = static_cast<GLuint>(number(GL_SHADER_STORAGE_BUFFER_BINDING));
        if (buffer == 0) glGenBuffers(1, &buffer);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
        glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(words.size() * sizeof(GLuint)), words.data(),
                     GL_DYNAMIC_READ);
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, before);
    }

    void collect() {
        if (!pending) return;
        const Pending what = *std::exchange(pending, std::nullopt);
        std::vector<std::uint32_t> counts(what.words);
        const auto before = static_cast<GLuint>(number(GL_SHADER_STORAGE_BUFFER_BINDING));
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
        readBuffer(GL_SHADER_STORAGE_BUFFER, headerWords * sizeof(GLuint),
                   static_cast<GLsizeiptr>(counts.size() * sizeof(GLuint)), counts.data());
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, before);
        passes[what.key].add(what.group == 0 ? passesOfPixels(counts, what.marks, what.width, what.height)
                                             : passesOfGroups(counts, what.marks, what.group));
    }

    static void APIENTRY onSource(GLuint shader, GLsizei count, const GLchar* const* strings, const GLint* lengths) {
        std::string text;
        for (GLsizei i = 0; i < count; ++i)
            text += lengths != nullptr && lengths[i] >= 0 ? std::string(strings[i], static_cast<std::size_t>(lengths[i]))
                                                          : std::string(strings[i]);
        living->state_->give(shader, text);
    }

    /// What was given, to all who ask.
    static void APIENTRY onGetSource(GLuint shader, GLsizei size, GLsizei* length, GLchar* text) {
        State& state = *living->state_;
        const auto found = state.sources.find(shader);
        if (found == state.sources.end()) return state.getShaderSource(shader, size, length, text);
        const std::size_t copied = found->second.text.copy(text, static_cast<std::size_t>(size) - 1);
        text[copied] = '\0';
        if (length != nullptr) *length = static_cast<GLsizei>(copied);
    }

    static void APIENTRY onGet(GLuint shader, GLenum what, GLint* value) {
        State& state = *living->state_;
        const auto found = state.sources.find(shader);
        if (what == GL_SHADER_SOURCE_LENGTH && found != state.sources.end())
            *value = static_cast<GLint>(found->second.text.size() + 1);
        else
            state.getShader(shader, what, value);
    }
};

Counter::Counter() : state_(std::make_unique<State>()) {
    if (living != nullptr) throw InternalError("a second counter of a frame's waves was made beside a living one");
    living = this;
    state_->binding = static_cast<GLuint>(number(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS) - 1);
    glShaderSource = State::onSource;
    glGetShaderSource = State::onGetSource;
    glGetShaderiv = State::onGet;
}

Counter::~Counter() {
    glShaderSource = state_->shaderSource;
    glGetShaderSource = state_->getShaderSource;
    glGetShaderiv = state_->getShader;
    if (state_->buffer != 0) glDeleteBuffers(1, &state_->buffer);
    living = nullptr;
}

void Counter::draw(const std::string& key) {
    std::array<GLint, 4> view{};
    glGetIntegerv(GL_VIEWPORT, view.data());
    Pending next{key, state_->marksInUse()};
    next.width = static_cast<std::size_t>(std::max(view[0] + view[2], 1));
    next.height = static_cast<std::size_t>(std::max(view[1] + view[3], 1));
    next.framebuffer = number(GL_DRAW_FRAMEBUFFER_BINDING);
    state_->begin(std::move(next), true);
}

void Counter::dispatch(const std::string& key, std::array<unsigned, 3> groups, unsigned invocationsOfGroup) {
    Pending next{key, state_->marksInUse()};
    next.group = invocationsOfGroup;
    next.words = std::size_t{groups[0]} * groups[1] * groups[2] * invocationsOfGroup;
    state_->begin(std::move(next), false);
}

std::map<std::string, WavePasses> Counter::take() {
    state_->collect();
    return std::exchange(state_->passes, {});
}

} // namespace shadowbench::gpu
