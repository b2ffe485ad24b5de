#include "studies/causes/explanation.h"

#include "harness/cells/cell.h"
#include "harness/metrics/pixels.h"
#include "studies/causes/casters_alone.h"
#include "studies/causes/experiments.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <tuple>

namespace shadowbench::causes {
namespace {

/// The scored frame where nothing has moved before it.
Snapshot heldStill(const Scene& scene, int scored) {
    Snapshot still = snapshot(scene, scored);
    still.previousCamera = still.camera;
    for (Batch& batch : still.batches) {
        batch.moving = false;
        batch.previousMesh.reset();
        for (Placement& placement : batch.placements) placement.previous = placement.world;
    }
    return still;
}

/// Draws a row's scored frame, with other parameters and casters if need be, and says how wrong it is.
class Row {
public:
    Row(SceneFrames& frames, const Entry& entry, Truth kind, std::uint32_t seed)
        : frames_(frames), entry_(entry), soft_(kind == Truth::Soft), seed_(seed) {
        frames_.show(frames_.scored());
        truth_ = &frames_.truth(kind);
        mask_ = &frames_.mask(kind);
    }

    [[nodiscard]] const groundtruth::Reference& truth() const { return *truth_; }
    [[nodiscard]] const metrics::Mask& mask() const { return *mask_; }
    [[nodiscard]] bool isSoft() const { return soft_; }

    /// From the first frame on, as a run draws it; null: the scene's own casters.
    Image<float> drawn(techniques::Technique& technique, const std::vector<Batch>* casters) {
        renderScored(frames_, entry_, technique, seed_, casters);
        return shown();
    }

    /// The scored frame alone, until a history has settled.
    Image<float> settled(const Parameters& parameters) {
        constexpr int frames = 128; // twice those that scenes stand still for
        const auto technique = entry_.make(parameters);
        frames_.stage().show(heldStill(frames_.scene(), frames_.scored()));
        // What stands alone is drawn as the frame that it is in a run, whose number chooses its noise.
        const int last = entry_.temporal ? frames - 1 : frames_.scored() + frames_.scene().timeline.approach;
        for (int frame = entry_.temporal ? 0 : last; frame <= last; ++frame)
            frames_.stage().render(*technique, frame, seed_);
        return shown();
    }

    /// What is drawn with each of `casters`, in order.
    std::vector<Image<float>> drawnWith(const Parameters& parameters, const std::vector<std::vector<Batch>>& casters) {
        const auto technique = entry_.make(parameters);
        std::vector<Image<float>> images;
        for (const std::vector<Batch>& some : casters) {
            technique->reset();
            images.push_back(drawn(*technique, &some));
        }
        return images;
    }

    [[nodiscard]] Image<float> errors(const Image<float>& v) const {
        Image<float> result(v.width(), v.height());
        for (std::size_t i = 0; i < v.size(); ++i)
            if (mask_->scored[i]) result[i] = std::abs(v[i] - truth_->visibility[i]);
        return result;
    }

private:
    /// Of hard and filtered answers the labels, which are what is scored.
    [[nodiscard]] Image<float> shown() {
        Image<float> v = frames_.stage().visibility();
        if (!soft_)
            for (float& pixel : v) pixel = metrics::isLit(pixel) ? 1 : 0;
        return v;
    }

    SceneFrames& frames_;
    const Entry& entry_;
    bool soft_;
    std::uint32_t seed_;
    const groundtruth::Reference* truth_ = nullptr;
    const metrics::Mask* mask_ = nullptr;
};

/// What the single casters allow their combination, at a pixel: never lighter than the darkest of them, never darker than
/// all that they hide together. What the ground alone hides, such as by acne, no caster does.
struct Allowed {
    float low, high;
};
Allowed allowedAt(const std::vector<Image<float>>& alone, std::size_t pixel) {
    const float ground = alone.front()[pixel];
    float hidden = 0, high = ground;
    for (std::size_t i = 1; i < alone.size(); ++i) {
        hidden += std::max(0.0F, ground - alone[i][pixel]);
        high = std::min(high, alone[i][pixel]);
    }
    return {std::max(0.0F, ground - hidden), high};
}

/// What nineteen in twenty errors are below where a single caster hides a part of the light: there nothing is combined, and
/// as large an error where two do is none of their combination. 0 of labels, which hide all or nothing.
float errorOfSingles(const std::vector<Image<float>>& alone, const Image<float>& errors) {
    constexpr float least = 0.01F; // less is noise
    std::vector<double> single;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const float ground = alone.front()[i];
        int hiding = 0, partly = 0;
        for (std::size_t c = 1; c < alone.size(); ++c) {
            if (alone[c][i] >= ground - least) continue;
            ++hiding;
            if (alone[c][i] > least) ++partly;
        }
        if (hiding == 1 && partly == 1) single.push_back(errors[i]);
    }
    return single.empty() ? 0 : static_cast<float>(metrics::quantile(single, 0.95));
}

/// The experiments on one row, in order.
class Explainer {
public:
    Explainer(SceneFrames& frames, const techniques::Variant& variant, std::uint32_t seed, const std::vector<Batch>* casters)
        : frames_(frames), entry_(*variant.entry), row_(frames, entry_, mainTruth(frames.scene(), variant), seed),
          parameters_(variant.parameters), now_(parameters_), technique_(entry_.make(now_)),
          v_(row_.drawn(*technique_, casters)), error_(row_.errors(v_)), ladder_(error_) {
        if (casters != nullptr) {
            technique_ = entry_.make(now_);
            replace(Cause::Geometry, row_.drawn(*technique_, nullptr));
        }
        outside();
        combination();
        if (entry_.temporal) replace(Cause::History, row_.settled(now_));
        if (!row_.isSoft()) change(Cause::Filter, withLeastFilter(entry_, now_));
        change(Cause::SmallBias, withEnoughBias(entry_, now_));
        change(Cause::Undersampled, withFineTexels(entry_, now_));
        change(Cause::LargeBias, withOwnBias(entry_, now_)); // enough of it is there by now
        lessBias();
        if (row_.isSoft()) change(Cause::FewSamples, withMoreSamples(entry_, now_));
    }

    /// Mean error of the row.
    [[nodiscard]] double meanOf(const Image<float>& errors) const {
        double sum = 0;
        for (const float e : errors) sum += e;
        return row_.mask().count == 0 ? 0 : sum / static_cast<double>(row_.mask().count);
    }

    Explanation result(const techniques::Variant& variant) && {
        Explanation result{
            frames_.scene().id,          variant.name, row_.isSoft() ? "mae" : "mismatch", meanOf(error_), {}, {},
            std::move(ladder_).finish(), &row_.truth()};
        for (const auto& [cause, errors] : result.split) result.parts.emplace_back(cause, meanOf(errors));
        std::ranges::stable_sort(result.parts, std::greater<>(), &std::pair<Cause, double>::second);
        if (!result.isRight()) result.change = firstChange(result);
        return result;
    }

private:
    /// The image without the cause takes the place of the row's.
    void replace(Cause cause, Image<float> v) {
        Image<float> after = row_.errors(v);
        ladder_.take(cause, row_.errors(v_), after);
        v_ = std::move(v);
    }

    /// What most of the error can be changed by, if that is any of it to speak of.
    [[nodiscard]] std::string firstChange(const Explanation& explanation) const {
        constexpr double least = 0.1; // of the error
        const auto worthwhile = [&](const auto& part) {
            return part.second >= least * explanation.error && !changeAgainst(part.first, entry_, parameters_).empty();
        };
        const auto found = std::ranges::find_if(explanation.parts, worthwhile);
        if (found == explanation.parts.end()) return lacksClosedMeshes() ? "close the meshes" : "the method itself";
        const bool hasSeenMotion = frames_.scene().timeline.approach > 0;
        if (found->first == Cause::History && !hasSeenMotion) return "more still frames";
        return changeAgainst(found->first, entry_, parameters_);
    }

    [[nodiscard]] bool lacksClosedMeshes() const {
        const std::vector<Batch> casters = snapshot(frames_.scene(), frames_.scored()).batches;
        const bool isOpen = std::ranges::any_of(casters, [](const Batch& batch) { return !batch.mesh->closed; });
        return isOpen && entry_.lacks.contains(techniques::Need::OpenMeshes);
    }

    void change(Cause cause, std::optional<Parameters> changed) {
        if (!changed) return;
        now_ = std::move(*changed);
        replace(cause, row_.settled(now_));
    }

    /// Even the default's may be more than the scene asks for. Acne may be worse than what it shows: then this tells
    /// nothing.
    void lessBias() {
        const auto less = withLessBias(entry_, now_);
        if (!less) return;
        Image<float> v = row_.settled(*less);
        if (meanOf(row_.errors(v)) >= meanOf(row_.errors(v_))) return;
        now_ = *less;
        replace(Cause::LargeBias, std::move(v));
    }

    /// Receivers that no map holds, of a technique that has one; and casters that it loses.
    void outside() {
        if (auto changed = withAllCasters(entry_, now_)) {
            now_ = std::move(*changed);
            const auto technique = entry_.make(now_);
            replace(Cause::Outside, row_.drawn(*technique, nullptr));
        }
        const Image<glm::vec3>& positions = frames_.drawn().position;
        Image<float> errors = row_.errors(v_), inside = errors;
        bool hasMap = false;
        for (std::size_t i = 0; i < errors.size(); ++i) {
            if (!row_.mask().scored[i]) continue;
            if (technique_->mapPoint(glm::dvec3(positions[i])))
                hasMap = true;
            else
                inside[i] = 0;
        }
        if (hasMap) ladder_.take(Cause::Outside, errors, inside);
    }

    /// The nearest that a combination of the row's own single casters can be to the truth.
    void combination() {
        const std::uint32_t most = row_.isSoft() ? 8 : 16; // soft rows take longer
        const auto ground = static_cast<std::uint32_t>(frames_.scene().objects.front().instances.size());
        const auto casters = castersAlone(snapshot(frames_.scene(), frames_.scored()).batches, ground, most);
        // A history would have to settle for each; under an environment what is computed ahead would be computed for each.
        if (casters.empty() || entry_.temporal || frames_.scene().light.isEnvironment()) return;
        const std::vector<Image<float>> alone = row_.drawnWith(now_, casters);
        Image<float> best = v_;
        for (std::size_t i = 0; i < best.size(); ++i) {
            const Allowed allowed = allowedAt(alone, i);
            best[i] = std::clamp(row_.truth().visibility[i], std::min(allowed.low, allowed.high), allowed.high);
        }
        const Image<float> errors = row_.errors(v_);
        const float usual = errorOfSingles(alone, errors);
        Image<float> after = row_.errors(best);
        for (std::size_t i = 0; i < after.size(); ++i)
            if (errors[i] <= usual) after[i] = std::max(after[i], errors[i]); // what it makes worse is still that
        const auto causeAt = [&](std::size_t i) { return v_[i] > allowedAt(alone, i).high ? Cause::Leak : Cause::Fusion; };
        ladder_.take({Cause::Leak, Cause::Fusion}, causeAt, errors, after);
    }

    SceneFrames& frames_;
    const Entry& entry_;
    Row row_;
    Parameters parameters_;
    Parameters now_; // of the experiment that was made last
    std::unique_ptr<techniques::Technique> technique_;
    Image<float> v_; // what it drew
    Image<float> error_;
    Ladder ladder_;
};

} // namespace

Explanation explain(SceneFrames& frames, const techniques::Variant& row, std::uint32_t seed,
                    const std::vector<Batch>* casters) {
    return Explainer(frames, row, seed, casters).result(row);
}

Image<glm::vec3> causePicture(const Explanation& explanation) {
    const groundtruth::Reference& truth = *explanation.truth;
    Image<glm::vec3> picture(truth.visibility.width(), truth.visibility.height(), glm::vec3(0.08F));
    for (std::size_t i = 0; i < picture.size(); ++i) {
        if (truth.surface[i] != groundtruth::Surface::Receiver) continue;
        float error = 0, largest = 0;
        Cause dominant = Cause::Method;
        for (const auto& [cause, errors] : explanation.split) {
            error += errors[i];
            if (errors[i] > largest) std::tie(largest, dominant) = std::tuple(errors[i], cause);
        }
        const float strength = std::min(1.0F, 2 * error); // half of full light is already full colour
        picture[i] = (1 - strength) * glm::vec3(0.25F + 0.5F * truth.visibility[i]) + strength * words(dominant).colour;
    }
    return picture;
}

} // namespace shadowbench::causes
