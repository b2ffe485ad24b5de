#include "studies/shader_cost/shader_cost.h"

#include "base/files.h"
#include "base/parallel.h"
#include "base/progress_line.h"
#include "base/worker_processes.h"
#include "gpu/formats.h"
#include "gpu/standalone.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/cell.h"
#include "harness/cells/cell_selection.h"
#include "harness/cells/lod_cell.h"
#include "harness/render/shared_shaders.h"
#include "scene/load/load.h"
#include "studies/shader_cost/figure_store.h"
#include "studies/shader_cost/frame_pipelines.h"
#include "studies/shader_cost/given_shaders.h"
#include "studies/shader_cost/lines.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>

namespace shadowbench::shaders {
namespace {

using Architectures = std::vector<const gpu::Architecture*>;

Architectures chosenArchitectures(const std::vector<std::string>& ids) {
    Architectures chosen;
    for (const std::string& id : ids) chosen.push_back(&gpu::architectureNamed(id));
    if (ids.empty())
        for (const gpu::Architecture& each : gpu::architectures()) chosen.push_back(&each);
    return chosen;
}

/// The first thing that is wrong is the missing driver, whatever else is; and this process opens none, which forks.
void requireCompiler() {
    checkInOwnProcess([] { (void)gpu::compilerVersion(); });
}

/// Gives shaders of one technique, pass, stage and source their numbers.
void addNumbers(std::vector<ShaderCost>& shaders) {
    std::map<std::string, int> seen;
    for (ShaderCost& shader : shaders) {
        shader.number = 1;
        shader.number = ++seen[shader.name() + shader.architecture];
    }
}

/// Of the counted shader of a pipeline that the steady frame uses; no marks where it has neither loop nor branch.
struct Counted {
    const FramePipeline& pipeline;
    std::vector<gpu::Busy> marks;
};

void addExecuted(ShaderCost& row, const gpu::StageFigures& figures, const Counted& counted) {
    if (row.stage == gpu::Stage::Vertex || counted.pipeline.draws == 0) return;
    row.executed = gpu::executed(figures, counted.marks, counted.pipeline.passes);
    row.marks = counted.pipeline.passes.waves64.size();
    if (const auto& larger = counted.pipeline.larger)
        row.larger = {larger->first, gpu::executed(figures, counted.marks, larger->second)};
}

/// The rows of one pipeline on one architecture; shaders without a name are none of the user's.
void addRows(std::vector<ShaderCost>& rows, const ShaderCost& shared, const FrameShaders& sources,
             const std::vector<gpu::StageFigures>& figures, const Counted* counted = nullptr) {
    for (const gpu::StageFigures& stage : figures) {
        const auto source = std::ranges::find(sources, stage.stage, &std::pair<gpu::Stage, std::string>::first);
        if (source == sources.end() || source->second.empty()) continue;
        ShaderCost& row = rows.emplace_back(shared);
        row.stage = stage.stage;
        row.source = source->second;
        row.statistics = stage.statistics;
        if (counted != nullptr) addExecuted(row, stage, *counted);
    }
}

FrameShaders sourcesOf(const gpu::Pipeline& pipeline) {
    FrameShaders sources;
    for (const gpu::Shader& shader : pipeline.shaders) sources.emplace_back(shader.stage, shader.name);
    return sources;
}

FramePipeline pipelineOf(const gpu::Use& use, const gpu::Use* larger) {
    FramePipeline pipeline{use.pass, use.draws, use.pipeline.digest(), sourcesOf(use.pipeline), {}};
    const gpu::State& state = use.pipeline.state;
    for (const gpu::ColourTarget& colour : state.colours)
        if (colour.writeMask != 0) {
            pipeline.output.colours.push_back(gpu::formatName(colour.format));
            pipeline.output.blends |= colour.blends;
        }
    pipeline.output.depth = gpu::formatName(state.depthFormat);
    pipeline.output.writesDepth = state.depthTest && state.depthWrite;
    pipeline.output.extents = use.extents;
    pipeline.passes = use.passes;
    if (larger != nullptr) pipeline.larger = {larger->extents, larger->passes};
    return pipeline;
}

/// What the workers share: each does items, and this process puts their answers in order.
class Study {
public:
    Study(const ShaderCostOptions& options, Architectures architectures)
        : architectures_(std::move(architectures)),
          cache_(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache), store_(cache_ / "gpu"),
          quiet_(options.quiet) {}
    virtual ~Study() = default;

    ShaderCostResult all() {
        const std::size_t count = items();
        std::vector<std::size_t> order(count); // the long ones first: no process waits for one of them at the end
        std::iota(order.begin(), order.end(), 0U);
        std::stable_partition(order.begin(), order.end(), [this](std::size_t item) { return isLong(item); });
        std::vector<std::string> answers(count);
        ProgressLine line("shader-cost", static_cast<int>(count), quiet_);
        int done = 0;
        SharedWork work;
        work.items = count;
        work.work = [&](std::size_t at, const Progress&) { return answerOf(order[at]); };
        work.leave = [this] { leave(); };
        work.progress = [&](std::size_t at, double share, std::string_view) { line.show(done, share, nameOf(order[at])); };
        work.finished = [&](std::size_t at, std::string answer) {
            line.show(++done, 0, nameOf(order[at]));
            answers[order[at]] = std::move(answer);
        };
        work.lost = [&](std::size_t at, const std::string& how) {
            answers[order[at]] = fmt::format("{}\nthe process that compiled it {}; Mesa's compiler may not stand the shader",
                                             static_cast<int>(ExitCode::Internal), how);
        };
        shareAmongProcesses(availableThreads(), work);
        ShaderCostResult result;
        for (std::size_t item = 0; item < count; ++item) add(result, item, answers[item]);
        return result;
    }

protected:
    [[nodiscard]] virtual std::size_t items() const = 0;
    [[nodiscard]] virtual std::string nameOf(std::size_t item) const = 0;
    [[nodiscard]] virtual bool isLong(std::size_t /*item*/) const { return false; }
    /// In a worker.
    virtual ShaderCosts costsOf(std::size_t item) = 0;
    virtual void leave() {}

    [[nodiscard]] const Architectures& architectures() const { return architectures_; }
    [[nodiscard]] const std::filesystem::path& cache() const { return cache_; }
    FigureStore& store() { return store_; }

private:
    /// The exit code, then the lines or the error.
    std::string answerOf(std::size_t item) {
        try {
            ShaderCosts costs = costsOf(item);
            costs.compiler = gpu::compilerVersion();
            addNumbers(costs.shaders);
            return "0\n" + toLines(costs);
        } catch (const Error& error) {
            return fmt::format("{}\n{}", static_cast<int>(error.code()), error.what());
        }
    }

    void add(ShaderCostResult& result, std::size_t item, const std::string& answer) const {
        const std::size_t end = answer.find('\n');
        const auto code = static_cast<ExitCode>(std::stoi(answer.substr(0, end)));
        if (code != ExitCode::Pass) {
            result.errors.push_back(fmt::format("{}: {}", nameOf(item), answer.substr(end + 1)));
            if (result.code == ExitCode::Pass) result.code = code;
            return;
        }
        ShaderCosts costs = parseLines(answer.substr(end + 1), nameOf(item));
        result.costs.compiler = costs.compiler;
        std::ranges::move(costs.shaders, std::back_inserter(result.costs.shaders));
        std::ranges::move(costs.moves, std::back_inserter(result.costs.moves));
    }

    Architectures architectures_;
    std::filesystem::path cache_;
    FigureStore store_;
    bool quiet_;
};

class GivenShaders : public Study {
public:
    GivenShaders(const ShaderCostOptions& options, Architectures architectures)
        : Study(options, std::move(architectures)), programs_(programsOf(options.files)) {}

protected:
    [[nodiscard]] std::size_t items() const override { return programs_.size(); }
    [[nodiscard]] std::string nameOf(std::size_t item) const override { return programs_[item].front().name; }

    ShaderCosts costsOf(std::size_t item) override {
        const gpu::Pipeline pipeline = gpu::pipelineOf(programs_[item]);
        std::vector<ShaderCost> rows;
        for (const gpu::Architecture* architecture : architectures()) {
            ShaderCost shared{};
            shared.draws = 1;
            shared.architecture = architecture->id;
            addRows(rows, shared, sourcesOf(pipeline), store().get(pipeline, *architecture));
        }
        return {"", rows};
    }

private:
    std::vector<std::vector<gpu::Shader>> programs_;
};

/// The scene that a variant is drawn on.
struct Place {
    techniques::Variant variant;
    std::shared_ptr<const Scene> scene;
    bool isBuiltIn;
};

std::optional<std::string> reasonAgainst(const Scene& scene, const techniques::Variant& variant) {
    return variant.isLod() ? lod::notApplicable(scene) : notApplicable(scene, variant);
}

/// `simple` has spheres on a plane, a point light and a walk: most that there is. What has no answer there is drawn on the
/// first other scene on which it has.
std::vector<std::string> scenesToTry(const std::string& asked) {
    if (!asked.empty()) return {asked};
    std::vector<std::string> names{"simple"};
    std::ranges::copy(builtinScenes(), std::back_inserter(names));
    return names;
}

class CatalogueShaders : public Study {
public:
    CatalogueShaders(const ShaderCostOptions& options, Architectures architectures)
        : Study(options, std::move(architectures)), counted_(options.frame), names_(scenesToTry(options.scene)) {
        for (techniques::Variant& variant : chosenVariants(options.techniques)) choosePlace(std::move(variant));
    }

    [[nodiscard]] const std::map<std::string, std::string>& notApplicable() const { return reasons_; }

protected:
    [[nodiscard]] std::size_t items() const override { return places_.size(); }
    [[nodiscard]] std::string nameOf(std::size_t item) const override { return places_[item].variant.name; }
    void leave() override { context_.reset(); }
    /// Radiance transfer, which is computed before the first frame.
    [[nodiscard]] bool isLong(std::size_t item) const override {
        return places_[item].variant.entry->environment == techniques::EnvironmentAnswer::Only;
    }

    ShaderCosts costsOf(std::size_t item) override {
        const Place& place = places_[item];
        static constexpr const char* frames[] = {"", "first frame ", "frame in motion "}; // by CountedFrame
        const std::string key =
            fmt::format("pipelines of {}{} {} on {} by {}", frames[static_cast<std::size_t>(counted_)], place.variant.name,
                        place.variant.entry->digest, place.scene->id, drawingSources());
        if (place.isBuiltIn)
            if (const auto kept = keptList(key))
                if (auto costs = keptCosts(place, frameList(*kept))) return *std::move(costs);
        if (!context_) context_ = contextOfRun(cache(), false);
        FrameList list;
        ShaderCosts costs;
        const FrameUses frame = pipelinesOf(*place.scene, place.variant, counted_);
        list.frame = frame.frame;
        for (const gpu::Use& use : frame.uses) {
            const FramePipeline& pipeline = list.pipelines.emplace_back(pipelineOf(use, frame.larger(use)));
            for (const gpu::Architecture* each : architectures()) {
                Counted counted{pipeline, {}};
                if (!pipeline.passes.empty()) counted.marks = store().getMarks(use.pipeline, *each);
                addRows(costs.shaders, sharedOf(place, list, pipeline, *each), pipeline.shaders,
                        store().get(use.pipeline, *each), frame.isCounted ? &counted : nullptr);
            }
        }
        for (const gpu::Move& move : frame.moves)
            list.moves.push_back({"", "", move.pass, move.kind, gpu::formatName(move.format), move.extents});
        if (place.isBuiltIn && frame.isCounted) keepList(key, frame.shaderFiles, list);
        costs.moves = movesOf(place, std::move(list.moves));
        return costs;
    }

private:
    void choosePlace(techniques::Variant variant) {
        const std::vector<std::string> builtIn = builtinScenes();
        std::string reason;
        for (const std::string& name : names_) {
            const std::shared_ptr<const Scene> scene = sceneNamed(name);
            const auto against = reasonAgainst(*scene, variant);
            if (!against) {
                places_.push_back({std::move(variant), scene, std::ranges::find(builtIn, name) != builtIn.end()});
                return;
            }
            if (reason.empty()) reason = *against;
        }
        reasons_[variant.name] = reason;
    }

    std::shared_ptr<const Scene> sceneNamed(const std::string& name) {
        auto& scene = scenes_[name];
        if (scene == nullptr) scene = std::make_shared<const Scene>(loadScene(name, Profile::Gate));
        return scene;
    }

    /// A list is kept by the texts of all shaders that were compiled for it, and their names by all else: what compiles
    /// other shaders than before has either another program or another text of one that is named.
    [[nodiscard]] std::optional<std::string> keptList(const std::string& key) {
        const auto names = store().text(key);
        if (!names) return std::nullopt;
        std::istringstream lines(*names);
        std::set<std::string> files;
        for (std::string line; std::getline(lines, line);) files.insert(line);
        return store().text(fmt::format("{} with {}", key, textsOf(files)));
    }

    void keepList(const std::string& key, const std::set<std::string>& files, const FrameList& list) {
        store().keepText(fmt::format("{} with {}", key, textsOf(files)), toText(list));
        store().keepText(key, fmt::format("{}\n", fmt::join(files, "\n")));
    }

    static ShaderCost sharedOf(const Place& place, const FrameList& list, const FramePipeline& pipeline,
                               const gpu::Architecture& architecture) {
        ShaderCost shared{};
        shared.technique = place.variant.name;
        shared.scene = place.scene->id;
        shared.frame = list.frame;
        shared.pass = pipeline.pass;
        shared.draws = pipeline.draws;
        shared.output = pipeline.output;
        shared.architecture = architecture.id;
        return shared;
    }

    static std::vector<FrameMove> movesOf(const Place& place, std::vector<FrameMove> moves) {
        for (FrameMove& move : moves) {
            move.technique = place.variant.name;
            move.scene = place.scene->id;
        }
        return moves;
    }

    /// Nothing where the figures of a pipeline are not kept for each architecture.
    [[nodiscard]] std::optional<ShaderCosts> keptCosts(const Place& place, const FrameList& list) {
        ShaderCosts costs;
        for (const FramePipeline& pipeline : list.pipelines)
            for (const gpu::Architecture* each : architectures()) {
                const auto figures = store().find(pipeline.digest, *each);
                if (!figures) return std::nullopt;
                Counted counted{pipeline, {}};
                if (!pipeline.passes.empty()) {
                    auto marks = store().findMarks(pipeline.digest, *each);
                    if (!marks) return std::nullopt;
                    counted.marks = *std::move(marks);
                }
                addRows(costs.shaders, sharedOf(place, list, pipeline, *each), pipeline.shaders, *figures, &counted);
            }
        costs.moves = movesOf(place, list.moves);
        return costs;
    }

    CountedFrame counted_;
    std::vector<std::string> names_;
    std::map<std::string, std::shared_ptr<const Scene>> scenes_;
    std::vector<Place> places_;
    std::map<std::string, std::string> reasons_;
    std::unique_ptr<gl::Context> context_; // of a worker
};

} // namespace

ShaderCostResult shaderCosts(const ShaderCostOptions& options) {
    Architectures architectures = chosenArchitectures(options.architectures);
    requireCompiler();
    if (!options.files.empty()) return GivenShaders(options, std::move(architectures)).all();
    CatalogueShaders study(options, std::move(architectures));
    ShaderCostResult result = study.all();
    result.notApplicable = study.notApplicable();
    return result;
}

} // namespace shadowbench::shaders
