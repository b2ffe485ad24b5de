#include "techniques/folder/folder_technique.h"

#include "base/error.h"
#include "base/worker_processes.h"
#include "techniques/contract/surroundings.h"
#include "techniques/folder/draw_state.h"
#include "techniques/folder/inputs.h"
#include "techniques/folder/pass_program.h"
#include "techniques/folder/patterns.h"
#include "techniques/folder/views.h"
#include "techniques/gl/api.h"
#include "techniques/shared/maps/depth_map.h"
#include "techniques/shared/maps/linearised_map.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <unordered_map>

namespace shadowbench::techniques {
namespace {

/// Confines drawing to one of several tiles, as long as it lives.
class Tiling {
public:
    Tiling(const Tile& tile, std::size_t tiles) {
        if (tiles == 1) return;
        glViewport(tile.at.x, tile.at.y, tile.size.x, tile.size.y);
        glScissor(tile.at.x, tile.at.y, tile.size.x, tile.size.y);
        glEnable(GL_SCISSOR_TEST);
    }
    ~Tiling() { glDisable(GL_SCISSOR_TEST); }
    Tiling(const Tiling&) = delete;
    Tiling& operator=(const Tiling&) = delete;
};

bool hasDepths(const gl::Texture* texture) { return isDepth(texture->format()); }

class FolderTechnique final : public Technique {
public:
    FolderTechnique(std::shared_ptr<const TechniqueFolder> folder, const Parameters& values)
        : folder_(std::move(folder)), values_(values), views_(*folder_, values_), patterns_(*folder_, values_) {
        for (const FolderPass& pass : folder_->passes) {
            if (!holds(pass.when, values_)) continue;
            passes_.push_back(&pass);
            programs_.push_back(programOf(*folder_, pass, values_, views_.count()));
        }
        if (folder_->mapParameters == MapParameters::None) return;
        bias_ = biasFrom(values_);
        followsPlane_ = followsPlane(values_);
    }

    void reset() override {
        historyFrames_ = 0;
        targets_.clear();
        views_.reset();
        keptFor_.reset();
    }

    void render(const Frame& frame, const gl::Texture& visibility) override {
        if (imageSize_ != frame.size) reset();
        imageSize_ = frame.size;
        if (targets_.empty()) makeTargets();
        const bool keeps = isKept(frame);
        clearStencils(keeps);
        views_.fit(frame, tiles_.empty() ? 0 : tiles_.front().size.x);
        for (std::size_t first = 0; first < passes_.size();) {
            const std::size_t end = endOfGroup(first);
            if (keeps && passes_[first]->once) {
                first = end;
                continue;
            }
            const int repetitions = static_cast<int>(valueOf(passes_[first]->repeat, values_));
            for (repetition_ = 0; repetition_ < repetitions; ++repetition_)
                for (std::size_t i = first; i < end; ++i) {
                    const auto pass = frame.pass(passes_[i]->name);
                    const bool isTold = !isBuiltIn() && sayDoing(fmt::format("the pass \"{}\"", passes_[i]->name));
                    draw(*passes_[i], programs_[i], frame, visibility);
                    if (isTold) glFinish(); // Mesa draws late, and one that hangs would be told as a later one
                }
            first = end;
        }
        for (auto& [name, target] : targets_)
            if (target.before) std::swap(target.now, *target.before);
        ++historyFrames_;
    }

    [[nodiscard]] std::optional<glm::dvec2> mapPoint(const glm::dvec3& world) const override {
        if (tiles_.empty() || views_.views().empty()) return {};
        const std::size_t view = views_.viewAt(world);
        std::optional<glm::dvec2> point = texelAt(views_.views()[view], world, tiles_[view].size);
        if (point) *point += tiles_[view].at;
        return point;
    }

private:
    struct Target {
        gl::Texture now;
        std::optional<gl::Texture> before = {}; // of a target with a history
    };

    /// Those of users may hang.
    [[nodiscard]] bool isBuiltIn() const { return folder_->entry.digest.empty(); }

    [[nodiscard]] Bias biasOf(const FolderPass& pass) const {
        if (pass.bias == MapBias::Parameters) return bias_;
        if (pass.bias == MapBias::Slope) return drawnBias(bias_);
        return {.factor = static_cast<float>(valueOf(pass.slopeOffset, values_)),
                .units = static_cast<float>(valueOf(pass.unitOffset, values_))};
    }

    [[nodiscard]] std::size_t endOfGroup(std::size_t first) const {
        const std::string& group = passes_[first]->group;
        std::size_t end = first + 1;
        while (!group.empty() && end < passes_.size() && passes_[end]->group == group) ++end;
        return end;
    }

    void makeTargets() {
        for (const FolderTarget& target : folder_->targets) {
            if (isLeftOut(*folder_, target, values_)) continue;
            const int side = static_cast<int>(valueOf(target.side, values_));
            if (!target.ofImage && (side < 1 || side > mostTexelsOfSide))
                throw BadInput(fmt::format("{}: target {} would have {} texels a side; 1 to {} are allowed",
                                           folder_->path.string(), target.name, side, mostTexelsOfSide));
            if (!target.ofImage && views_.tiles(side).front().size.x < 1)
                throw BadInput(fmt::format("{}: target {} has too few texels for {} views: {} a side",
                                           folder_->path.string(), target.name, views_.count(), side));
            const glm::ivec2 size = target.ofImage ? imageSize_ : sizeOf(views_.tiles(side));
            const bool linear = target.linear || (target.linearWhen && holds(target.linearWhen, values_));
            Target made{textureOf(target, size, linear)};
            if (target.history) {
                made.before = textureOf(target, size, linear);
                clear(*made.before);
            }
            targets_.emplace(target.name, std::move(made));
        }
        const auto casters =
            std::ranges::find_if(passes_, [](const FolderPass* pass) { return pass->kind == PassKind::Casters; });
        if (casters != passes_.end()) tiles_ = tilesOf((*casters)->to.front());
    }

    /// Of a target that casters are drawn into.
    [[nodiscard]] std::vector<Tile> tilesOf(const std::string& name) const {
        const auto target = std::ranges::find(folder_->targets, name, &FolderTarget::name);
        return views_.tiles(static_cast<int>(valueOf(target->side, values_)));
    }

    [[nodiscard]] gl::Texture textureOf(const FolderTarget& target, glm::ivec2 size, bool linear) const {
        const bool depths = isDepth(target.format);
        gl::Texture texture(formatOf(target, values_), size, linear ? gl::Filter::Linear : gl::Filter::Nearest,
                            depths ? gl::Wrap::BorderFar : gl::Wrap::ClampToEdge,
                            target.mipmaps ? gl::Levels::All : gl::Levels::One);
        if (target.compare) texture.compareDepth();
        return texture;
    }

    /// Whether passes that are drawn once have been drawn for what stands there.
    bool isKept(const Frame& frame) {
        if (std::ranges::none_of(passes_, [](const FolderPass* pass) { return pass->once; })) return false;
        Surroundings now(frame);
        const bool kept = keptFor_ == now;
        keptFor_ = std::move(now);
        return kept;
    }

    [[nodiscard]] bool isWrittenOnce(const std::string& target) const {
        return std::ranges::any_of(passes_,
                                   [&](const FolderPass* p) { return p->once && std::ranges::count(p->to, target) > 0; });
    }

    void clearStencils(bool keeps) const {
        for (const auto& [name, target] : targets_)
            if (target.now.format() == gl::Format::Depth32FStencil8 && !(keeps && isWrittenOnce(name)))
                gl::RenderTarget({&target.now}).clearStencil();
    }

    static void clear(const gl::Texture& texture) {
        const gl::RenderTarget target({&texture});
        if (isDepth(texture.format()))
            target.clearDepth(1);
        else if (texture.format() == gl::Format::RG32UI)
            target.clearColour(0, 0U);
        else
            target.clearColour(0, glm::vec4(0));
    }

    void draw(const FolderPass& pass, gl::Program& program, const Frame& frame, const gl::Texture& visibility) {
        std::vector<const gl::Texture*> attachments;
        for (const std::string& name : pass.to)
            attachments.push_back(name == visibilityTarget ? &visibility : &targets_.at(name).now);
        if (pass.kind == PassKind::Casters) {
            drawCasters(pass, program, frame, attachments);
        } else {
            setInputs(program, frame, views_.views());
            if (pass.kind == PassKind::Compute)
                compute(pass, program, attachments);
            else
                drawScreen(pass, program, attachments);
        }
        for (const std::string& name : pass.to)
            if (name != visibilityTarget && hasMipmaps(name)) targets_.at(name).now.makeMipmaps();
    }

    [[nodiscard]] bool hasMipmaps(const std::string& name) const {
        return std::ranges::find(folder_->targets, name, &FolderTarget::name)->mipmaps;
    }

    [[nodiscard]] bool addsUnits() const {
        return std::ranges::any_of(passes_, [](const FolderPass* pass) { return pass->bias == MapBias::Slope; });
    }

    /// `views`: those that the program draws into or reads.
    void setInputs(gl::Program& program, const Frame& frame, std::span<const LightView> views) const {
        const FolderState state{frame,          views,       tiles_, sizeOf(tiles_), views_.cascades(),
                                historyFrames_, repetition_, bias_,  followsPlane_,  addsUnits()};
        for (const auto& [name, type] : program.uniformTypes()) {
            if (isImage(type)) continue;
            const auto input = std::ranges::find(folderInputs(), name, &FolderInput::name);
            if (input != folderInputs().end()) input->set(program, name, state);
            patterns_.set(program, name, frame.snapshot.light);
            if (const auto target = targets_.find(name); target != targets_.end()) program.set(name, target->second.now);
            if (name.starts_with(historyPrefix))
                if (const auto target = targets_.find(name.substr(historyPrefix.size())); target != targets_.end())
                    program.set(name, *target->second.before);
        }
    }

    void compute(const FolderPass& pass, gl::Program& program, const std::vector<const gl::Texture*>& stored) const {
        for (std::size_t i = 0; i < stored.size(); ++i) program.setImage(pass.to[i], *stored[i]);
        const glm::uvec3 size = program.groupSize(), texels(stored.front()->size(), 1);
        glm::uvec3 groups = (texels + size - 1U) / size;
        for (int axis = 0; axis < std::ssize(pass.groups); ++axis) {
            const GroupCount& count = pass.groups[static_cast<std::size_t>(axis)];
            const int* number = std::get_if<int>(&count);
            groups[axis] = static_cast<unsigned>(
                number != nullptr ? *number : targets_.at(std::get<std::string>(count)).now.size()[axis]);
        }
        const std::int64_t all = std::int64_t{groups.x} * groups.y * groups.z;
        if (all > mostGroups)
            throw BadInput(fmt::format("{}: the pass \"{}\" would run {} work groups; {} are allowed",
                                       folder_->path.string(), pass.name, all, mostGroups));
        program.dispatchGroups(groups);
    }

    static void drawScreen(const FolderPass& pass, const gl::Program& program, std::vector<const gl::Texture*> attachments) {
        const auto colours =
            std::ranges::stable_partition(attachments, std::not_fn(hasDepths)).begin() - attachments.begin();
        const gl::RenderTarget target{std::span<const gl::Texture* const>(attachments)};
        if (pass.clear)
            for (std::ptrdiff_t i = 0; i < colours; ++i) target.clearColour(static_cast<int>(i), *pass.clear);
        target.bind();
        const DrawState state(pass);
        if (!pass.stencil && isDepth(attachments.front()->format()))
            program.drawScreenDepth();
        else
            program.drawScreen();
    }

    /// Where no depths are kept the nearest casters are found in a buffer of the program's own.
    void drawCasters(const FolderPass& pass, gl::Program& program, const Frame& frame,
                     std::vector<const gl::Texture*> attachments) {
        if (pass.depthTest && std::ranges::none_of(attachments, hasDepths)) {
            const glm::ivec2 size = attachments.front()->size();
            if (!ownDepths_ || ownDepths_->size() != size) ownDepths_.emplace(gl::Format::Depth32F, size);
            attachments.push_back(&*ownDepths_);
        }
        std::ranges::stable_partition(attachments, std::not_fn(hasDepths));
        const gl::RenderTarget target{std::span<const gl::Texture* const>(attachments)};
        const auto colours = std::ranges::count_if(attachments, std::not_fn(hasDepths));
        for (int i = 0; i < colours; ++i) target.clearColour(i, *pass.clear);
        if (pass.depthTest && !pass.peels) target.clearDepth(1);
        const std::vector<Tile> tiles = tilesOf(pass.to.front());
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            target.bind();
            const Tiling tiling(tiles[i], tiles.size());
            setInputs(program, frame, views_.views().subspan(i, 1));
            drawView(pass, program, frame, i);
        }
    }

    void drawView(const FolderPass& pass, gl::Program& program, const Frame& frame, std::size_t view) const {
        const CasterPass casters(program, views_.views()[view], biasOf(pass));
        const DrawState state(pass);
        if (const std::vector<bool>* shown = views_.casters(view))
            frame.scene.draw(*shown);
        else
            frame.scene.draw();
    }

    std::shared_ptr<const TechniqueFolder> folder_;
    Parameters values_;
    FolderViews views_;
    FolderPatterns patterns_;
    std::vector<const FolderPass*> passes_; // that are drawn with these parameters
    std::vector<gl::Program> programs_;     // a pass each
    std::vector<Tile> tiles_;               // of the first map; none where no casters are drawn
    std::unordered_map<std::string, Target> targets_;
    std::optional<gl::Texture> ownDepths_;
    std::optional<Surroundings> keptFor_; // of passes that are drawn once
    Bias bias_{};
    bool followsPlane_ = true;
    glm::ivec2 imageSize_{0};
    int historyFrames_ = 0, repetition_ = 0;
};

} // namespace

Entry folderEntry(TechniqueFolder folder) {
    const auto kept = std::make_shared<const TechniqueFolder>(std::move(folder));
    Entry entry = kept->entry;
    entry.make = [kept](const Parameters& values) { return std::make_unique<FolderTechnique>(kept, values); };
    return entry;
}

} // namespace shadowbench::techniques
