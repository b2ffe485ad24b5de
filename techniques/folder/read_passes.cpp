#include "base/one_line.h"
#include "base/words.h"
#include "techniques/folder/keys.h"
#include "techniques/folder/reading.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace shadowbench::techniques {
namespace {

constexpr int mostPasses = 64, mostRepetitions = 64;
constexpr int mostGroupsOfAxis = 65535;   // the least that GL promises
constexpr std::ptrdiff_t mostWritten = 7; // GL promises 8 of colour; casters may need depths beside them

class PassReader {
public:
    PassReader(const TomlValue& value, TechniqueFolder& read) : value_(value), read_(read) {}

    void add() {
        value_.only(keysOf(KeyTable::Pass));
        pass_.name = words(value_.get("name"));
        readKind();
        readTargets(value_.get("to"));
        readShader();
        if (const auto when = value_.find("when")) pass_.when = conditionOf(*when, read_);
        if (const auto peel = value_.find("peel")) pass_.peels = peel->boolean();
        if (const auto stencil = value_.find("stencil")) readStencil(*stencil);
        if (const auto blend = value_.find("blend")) pass_.blend = blends.named(blend->oneOf(blends.all()));
        if (const auto clear = value_.find("clear")) readClear(*clear);
        requireSomethingBelow();
        if (pass_.kind == PassKind::Casters) readCasters();
        if (pass_.kind == PassKind::Screen) requireScreen();
        if (pass_.kind == PassKind::Compute) readGroups();
        requireFloats();
        readRepetition();
        readOnce();
        read_.passes.push_back(std::move(pass_));
    }

private:
    [[nodiscard]] const FolderTarget* targetNamed(const std::string& name) const {
        const auto found = std::ranges::find(read_.targets, name, &FolderTarget::name);
        return found == read_.targets.end() ? nullptr : &*found;
    }

    void readKind() {
        if (!value_.find("compute")) {
            if (const auto groups = value_.find("work_groups"))
                groups->fail("is of a compute pass: say compute = \"FILE.comp\"");
            pass_.kind = draws.named(value_.get("draw").oneOf(draws.all()));
            return;
        }
        pass_.kind = PassKind::Compute;
        for (const char* key : {"draw", "fragment", "blend", "clear", "offset", "cull", "depth_test", "peel", "stencil"})
            if (const auto said = value_.find(key)) said->fail("is of a pass that draws; this one computes");
    }

    void readTargets(const TomlValue& to) {
        if (to.isList())
            for (const TomlValue& name : to.list()) addTarget(name);
        else
            addTarget(to);
        if (pass_.to.empty()) to.fail("names no target");
        if (std::ssize(pass_.to) > mostWritten) to.fail(fmt::format("a pass writes {} targets at most", mostWritten));
    }

    [[nodiscard]] bool hasStencil(const std::string& name) const {
        const FolderTarget* target = targetNamed(name);
        return target != nullptr && target->format == gl::Format::Depth32FStencil8;
    }

    /// Null: of visibility.
    [[nodiscard]] static std::pair<bool, Amount> sizeOf(const FolderTarget* target) {
        return target == nullptr ? std::pair(true, Amount(0.0)) : std::pair(target->ofImage, target->side);
    }

    /// `others`: names that might have stood there, too.
    [[nodiscard]] std::string noTarget(const std::string& name, std::vector<std::string> others) const {
        for (const FolderTarget& known : read_.targets) others.push_back(known.name);
        return fmt::format("there is no target \"{}\"{}", name, didYouMean(name, others));
    }

    void addTarget(const TomlValue& value) {
        const std::string name = value.text();
        const FolderTarget* target = targetNamed(name);
        if (target == nullptr && name != visibilityTarget) value.fail(noTarget(name, {visibilityTarget}));
        if (std::ranges::find(pass_.to, name) != pass_.to.end()) value.fail("is written twice");
        if (!pass_.to.empty()) {
            const std::string& first = pass_.to.front();
            if (const auto written = std::ranges::find(pass_.to, visibilityTarget);
                (written != pass_.to.end() && !hasStencil(name)) || (target == nullptr && !hasStencil(first)))
                value.fail("visibility is written alone, or with a stencil");
            if (sizeOf(target) != sizeOf(targetNamed(first)))
                value.fail(fmt::format("is of another size than {}; what a pass writes is of one size", first));
        }
        pass_.to.push_back(name);
    }

    void readShader() {
        if (const auto shader = value_.find(pass_.kind == PassKind::Compute ? "compute" : "fragment")) {
            pass_.shader = shader->text();
            if (!read_.shaders.contains(pass_.shader) && !gl::isEmbedded(pass_.shader)) shader->fail(noShader());
        } else if (pass_.kind == PassKind::Screen) {
            value_.fail("a pass over the screen needs a fragment shader: fragment = \"resolve.frag\"");
        }
        if (const auto defines = value_.find("define"))
            for (const TomlValue& define : defines->members()) addDefine(define);
    }

    [[nodiscard]] std::string noShader() const {
        std::vector<std::string> names;
        for (const auto& [file, text] : read_.shaders) names.push_back(file);
        return fmt::format("{} has no shader \"{}\"{}", read_.path.string(), pass_.shader, didYouMean(pass_.shader, names));
    }

    void addDefine(const TomlValue& value) {
        const std::string name = identifier(value, std::string(value.lastKey())), text = value.scalar();
        if (onOneLine(text) != text) value.fail("has line ends or other control characters; a macro is one line");
        for (const Parameter& parameter : read_.entry.parameters)
            if (std::ranges::count(macrosOf(parameter), name) > 0)
                value.fail(fmt::format("is the parameter {} already; choose another name", parameter.name));
        pass_.defines.emplace_back(name, text);
    }

    void readClear(const TomlValue& clear) {
        if (pass_.kind != PassKind::Casters && !pass_.blend)
            clear.fail("is of casters, or with blend: all else is drawn over");
        const std::vector<TomlValue> four = clear.list();
        if (four.size() != 4) clear.fail("expected four numbers");
        pass_.clear.emplace();
        for (int i = 0; i < 4; ++i) (*pass_.clear)[i] = static_cast<float>(four[static_cast<std::size_t>(i)].number());
    }

    /// Casters are drawn over cleared colours; over the screen blending takes what an earlier pass has drawn.
    void requireSomethingBelow() const {
        if (!pass_.blend || pass_.kind == PassKind::Casters || pass_.clear) return;
        const auto draws = [&](const FolderPass& before, const std::string& name) {
            return std::ranges::count(before.to, name) > 0 && (!before.when || before.when == pass_.when);
        };
        for (const std::string& name : pass_.to)
            if (std::ranges::none_of(read_.passes, [&](const FolderPass& before) { return draws(before, name); }))
                value_.get("blend").fail(fmt::format("no pass before has drawn {}: say clear = [0, 0, 0, 0]", name));
    }

    [[nodiscard]] std::ptrdiff_t depths() const {
        return std::ranges::count_if(pass_.to, [&](const std::string& name) {
            const FolderTarget* target = targetNamed(name);
            return target != nullptr && isDepth(target->format);
        });
    }

    void readCasters() {
        if (depths() > 1) value_.fail("one target of depths is all that a pass has");
        if (sizeOf(targetNamed(pass_.to.front())).first)
            value_.fail("casters are drawn into a map, which has a size of its own");
        if (pass_.shader.empty() && std::ssize(pass_.to) > depths()) value_.fail("colours need a fragment shader");
        if (pass_.peels && (depths() == 0 || pass_.shader.empty()))
            value_.get("peel").fail("needs a target of depths, behind which it draws, and another with a fragment shader");
        if (!pass_.clear) pass_.clear = glm::vec4(0);
        if (const auto cull = value_.find("cull")) pass_.cull = culls.named(cull->oneOf(culls.all()));
        if (const auto test = value_.find("depth_test")) {
            pass_.depthTest = test->boolean();
            if (!pass_.depthTest && depths() > 0)
                test->fail("a target of depths keeps the nearest: leave one of the two out");
        }
        if (const auto offset = value_.find("offset")) readOffset(*offset);
    }

    void readStencil(const TomlValue& value) {
        value.only(keysOf(KeyTable::Stencil));
        if (std::ranges::none_of(pass_.to, [&](const std::string& name) { return hasStencil(name); }))
            value.fail("needs a target with a stencil: name one of the format Depth32FStencil8 in `to`");
        FolderStencil stencil;
        const auto operation = [&](const char* key, StencilOperation& read) {
            if (const auto said = value.find(key)) read = stencilOperations.named(said->oneOf(stencilOperations.all()));
        };
        if (const auto test = value.find("test")) stencil.test = stencilTests.named(test->oneOf(stencilTests.all()));
        if (const auto reference = value.find("ref")) stencil.reference = reference->integer(0, 255);
        operation("pass", stencil.pass);
        operation("depth_fail", stencil.depthFail);
        operation("fail", stencil.fail);
        if (pass_.kind == PassKind::Screen && value.find("depth_fail"))
            value.get("depth_fail").fail("is of casters; over the screen no depth is tested");
        pass_.stencil = stencil;
    }

    void readOffset(const TomlValue& offset) {
        if (offset.isText()) {
            pass_.bias = biases.named(offset.oneOf(biases.all()));
            if (read_.mapParameters == MapParameters::None)
                offset.fail("is that of the parameters of a depth map: say depth_map = \"depth-bias\" above");
            return;
        }
        const std::vector<TomlValue> both = offset.list();
        if (both.size() != 2) offset.fail("expected [of the slope, units], numbers or parameters, or \"bias\"");
        pass_.slopeOffset = amountOf(both[0], read_);
        pass_.unitOffset = amountOf(both[1], read_);
    }

    /// What clears and blends: whole numbers are written texel by texel.
    void requireFloats() const {
        for (const std::string& name : pass_.to)
            if (const FolderTarget* target = targetNamed(name); target != nullptr && target->format == gl::Format::RG32UI)
                if (pass_.kind == PassKind::Casters || pass_.blend)
                    value_.fail(fmt::format("{} holds whole numbers, which are drawn over the screen without blend", name));
    }

    void requireScreen() const {
        if (depths() > 0 && !pass_.stencil && (pass_.to.size() > 1 || pass_.blend))
            value_.fail("a pass over the screen writes depths alone, by gl_FragDepth");
        if (depths() > 1) value_.fail("one target of depths is all that a pass has");
        for (const char* key : {"offset", "cull", "depth_test", "peel"})
            if (const auto said = value_.find(key)) said->fail("is of casters");
    }

    void readGroups() {
        if (depths() > 0) value_.get("to").fail("no image has depths: a pass over the screen writes them, by gl_FragDepth");
        const auto groups = value_.find("work_groups");
        if (!groups) return;
        const std::vector<TomlValue> three = groups->list();
        if (three.size() != 3) groups->fail("expected three: along x, y and z");
        for (const TomlValue& count : three) {
            if (!count.isText()) {
                pass_.groups.emplace_back(count.integer(1, mostGroupsOfAxis));
                continue;
            }
            if (targetNamed(count.text()) == nullptr) count.fail(noTarget(count.text(), {}));
            if (&count == &three.back()) count.fail("a target has no third side; say a number");
            pass_.groups.emplace_back(count.text());
        }
    }

    void readRepetition() {
        const FolderPass* before = read_.passes.empty() ? nullptr : &read_.passes.back();
        if (const auto group = value_.find("group")) {
            pass_.group = words(*group);
            const bool follows = before != nullptr && before->group == pass_.group;
            if (!follows && std::ranges::count(read_.passes, pass_.group, &FolderPass::group) > 0)
                group->fail("has passes above; those of a group come one after the other");
            if (follows && before->when != pass_.when) group->fail("has passes above that are drawn with another choice");
            if (follows && before->once != value_.find("once").has_value())
                group->fail("has passes above that are kept otherwise; say once of all or of none");
            if (follows && value_.find("repeat")) value_.get("repeat").fail("is said by the first pass of the group");
        }
        if (const auto repeat = value_.find("repeat"))
            pass_.repeat = amountWithin(*repeat, IntegerRange{1, mostRepetitions}, read_);
    }

    void readOnce() {
        if (const auto once = value_.find("once")) {
            pass_.once = changes.named(once->oneOf(changes.all()));
            if (read_.view != FolderView::Scene) once->fail("is of the view scene: the others change from frame to frame");
            for (const std::string& name : pass_.to) requireKept(*once, name);
        }
        for (const FolderPass& before : read_.passes)
            for (const std::string& name : pass_.to)
                if (before.once != pass_.once && std::ranges::count(before.to, name) > 0)
                    value_.get("to").fail(
                        fmt::format("{} is written by \"{}\" as well, one of them once and the other in each "
                                    "frame: say once of both or of none",
                                    name, before.name));
    }

    void requireKept(const TomlValue& once, const std::string& name) const {
        const FolderTarget* target = targetNamed(name);
        if (target == nullptr) once.fail("visibility is each frame's own; keep a target that it is made of");
        if (target->ofImage) once.fail(fmt::format("{} is as large as the image, whose camera moves: keep a map", name));
        if (target->history)
            once.fail(fmt::format("{} has a history, which each frame writes: leave one of the two out", name));
    }

    const TomlValue& value_;
    TechniqueFolder& read_;
    FolderPass pass_;
};

} // namespace

void readPasses(const TomlValue& list, TechniqueFolder& read) {
    const std::vector<TomlValue> passes = list.list();
    if (passes.empty() || passes.size() > mostPasses)
        list.fail(fmt::format("expected 1 to {} of them, got {}", mostPasses, passes.size()));
    for (const TomlValue& value : passes) PassReader(value, read).add();
    if (std::ranges::count(read.passes.back().to, visibilityTarget) == 0)
        passes.back().fail(R"(the last pass writes the answer: to = "visibility")");
    std::vector<std::string> kept;
    for (const FolderPass& pass : read.passes)
        if (pass.once && std::ranges::count(kept, pass.name) == 0) kept.push_back(pass.name);
    if (!kept.empty())
        read.entry.computed =
            fmt::format("when light or casters change, {}; each frame, the other passes", fmt::join(kept, ", "));
}

} // namespace shadowbench::techniques
