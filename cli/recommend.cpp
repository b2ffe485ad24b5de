#include "cli/command.h"
#include "cli/options.h"
#include "studies/recommend/recommendation_text.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <fmt/format.h>
#include <memory>
#include <sstream>

namespace shadowbench {
namespace {

struct RecommendWords {
    recommend::RecommendOptions options;
    std::vector<std::string> questions, needs;
    std::vector<std::string> levels;
    std::string profile = "gate";
    int frame = -1;
    bool json = false;
};

std::vector<int> wholeNumbers(const std::string& list) {
    std::vector<int> numbers;
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) {
        int number = 0;
        const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (failed != std::errc() || end != word.data() + word.size())
            throw BadInput(
                fmt::format("levels are numbers of triangles such as 600,300 or rotors=600,300, not \"{}\"", list));
        numbers.push_back(number);
    }
    return numbers;
}

/// "600,300" or "rotors=600,300".
void addChain(const std::string& word, recommend::Chains& chains) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos)
        chains[""] = wholeNumbers(word);
    else
        chains[word.substr(0, equals)] = wholeNumbers(word.substr(equals + 1));
}

recommend::RecommendOptions resolved(const RecommendWords& words) {
    recommend::RecommendOptions options = words.options;
    options.profile = profileNamed(words.profile);
    for (const std::string& word : words.questions) options.questions.insert(recommend::questionNamed(word));
    if (!words.needs.empty()) options.needs.clear();
    for (const std::string& word : words.needs) options.needs.insert(techniques::needNamed(word));
    for (const std::string& word : words.levels) addChain(word, options.casters.chains);
    if (words.frame >= 0) options.casters.frame = words.frame;
    return options;
}

ExitCode recommendAndPrint(const RecommendWords& words) {
    const recommend::Recommendations all = recommend::recommend(resolved(words));
    if (words.json)
        fmt::print("{}\n", recommend::json(all));
    else {
        for (const recommend::Recommendation& one : all.scenes) fmt::print("{}\n", recommend::text(one));
        fmt::print("{}", recommend::commonText(all));
    }
    return all.code;
}

} // namespace

void addRecommend(CLI::App& app, Action& action) {
    const auto words = std::make_shared<RecommendWords>();
    recommend::RecommendOptions& options = words->options;
    CLI::App* verb = app.add_subcommand(
        "recommend", "The least that a scene needs within its tolerance: caster levels, technique, map, samples");
    verb->footer(
        "casters: per object and distance band the coarsest level of detail whose shadow, all bands together, stays within\n"
        "tolerance of the finest levels' exact shadow; the choice of fewest triangles, verified by a second exact oracle "
        "at\n"
        "these levels and one level coarser. technique, map and samples are read off records: of --records, or of cells "
        "that\n"
        "are run for it.\n"
        "Ends with 5 if the second oracle does not confirm the casters' levels.\n"
        "Examples:\n  shadowbench recommend --scene windmills\n"
        "  shadowbench recommend --scene windmills --tolerance 0.01 --bands 14,20,28\n"
        "  shadowbench recommend --scene simple --levels 500,320,180,80,20 --json\n"
        "  shadowbench recommend --what technique --records results/published/results.jsonl\n"
        "  shadowbench recommend --scene hall.toml --what technique --static --needs any-receiver,any-eye\n"
        "  shadowbench recommend --scene hall.toml --what technique --card gtx-1080\n"
        "  shadowbench recommend --scene windmills --what map --technique 'sm-*'");
    verb->add_option("--scene", options.scenes,
                     "Scene id or file; repeatable (default: the standard scenes, for casters those with levels)");
    verb->add_option("--what", words->questions,
                     "casters, technique, map, samples; comma-separated (default: casters of a scene with levels; of others "
                     "technique, and the map that it needs)")
        ->delimiter(',');
    verb->add_option("--needs", words->needs,
                     "What the technique must be able to do, comma-separated: any-receiver (not one plane alone), any-eye "
                     "(in shadow, with casters behind it), moving-light, moving-casters, open-meshes, no-history (default: "
                     "all but no-history; with --static no moving ones)")
        ->delimiter(',');
    verb->add_option("--tolerance", options.casters.tolerance,
                     "Such as mismatch=0.01, or a number alone: of mismatch under a hard light, penumbra_rmse under an area "
                     "light; repeatable, and all of them must hold (default: the scene's)");
    verb->add_option("--bands", options.casters.bands,
                     "Distances from the eye between which casters share a level, in m, comma-separated (default: where the "
                     "scene changes its levels)")
        ->delimiter(',');
    verb->add_option("--levels", words->levels,
                     "Triangles of an object's levels, finest first, by simplification: 600,300,150 or, if several objects "
                     "have levels, rotors=600,300,150; repeatable (default: the scene's, and below the last a quarter "
                     "of the triangles each, down to no caster at all)");
    verb->add_option("--frame", words->frame, "Frame number (default: the scored one)")->check(CLI::NonNegativeNumber);
    verb->add_option("--light-samples", options.casters.lightSamples,
                     "Points of an area light that the casters' levels are verified from")
        ->check(CLI::Range(4, 16384))
        ->capture_default_str();
    verb->add_option("--technique", options.techniques,
                     "For technique, map and samples: variant or glob over ids; repeatable (default: all)");
    addTechniqueFolderOption(*verb, options.techniques);
    CLI::Option* records = verb->add_option("--records", options.records, "Records that answer technique, map and samples");
    verb->add_option("--out", options.out,
                     "Folder of the records of cells that are run; those of this program that it holds are kept")
        ->excludes(records)
        ->capture_default_str();
    verb->add_option("--card", options.card,
                     "Graphics card whose modelled milliseconds decide what is cheapest (default: that of the records, else "
                     "what is measured here)")
        ->type_name("TEXT:{geforce-7600-gt,gtx-1080,h200,rtx-2080-ti,rx-6800-xt}");
    addStaticOption(*verb, options.standing);
    addProfileOption(*verb, words->profile);
    addGlOption(*verb);
    verb->add_option("--cache", options.cache, "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    verb->add_flag("--json", words->json, "For machines");
    verb->add_flag("--quiet", options.quiet, "No progress");
    verb->callback([&action, words] { action = [words] { return recommendAndPrint(*words); }; });
}

} // namespace shadowbench
