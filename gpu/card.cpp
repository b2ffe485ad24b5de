#include "gpu/card.h"

#include "base/toml_value.h"
#include "base/words.h"
#include "embedded_cards.h"

#include <filesystem>

namespace shadowbench::gpu {
namespace {

constexpr Words<Rate, rateCount> rateNames{"rate",
                                           {{{Rate::Arithmetic, "arithmetic"},
                                             {Rate::Clock, "clock"},
                                             {Rate::Texture, "texture"},
                                             {Rate::Output, "output"},
                                             {Rate::OutputBytes, "output_bytes"},
                                             {Rate::BlendedBytes, "blended_bytes"},
                                             {Rate::Depth, "depth"},
                                             {Rate::Tested, "tested"},
                                             {Rate::Geometry, "geometry"},
                                             {Rate::Memory, "memory"},
                                             {Rate::Draws, "draws"},
                                             {Rate::Passes, "passes"},
                                             {Rate::Dependents, "dependents"},
                                             {Rate::ReadBacks, "read_backs"}}}};

int lanesOf(const TomlValue& value) {
    const int lanes = value.integer(32, 64);
    if (lanes != 32 && lanes != 64) value.fail("is neither 32 nor 64, the widths that waves are counted for");
    return lanes;
}

std::vector<Card> builtInCards() {
    std::vector<Card> all;
    for (const embedded::File& file : embedded::cards())
        all.push_back(parseCard(std::string(file.text), "gpu/cards/" + std::string(file.path)));
    return all;
}

} // namespace

std::string_view name(Rate rate) { return rateNames.of(rate); }

Card parseCard(const std::string& text, const std::string& file) {
    const toml::table table = parseToml(text, file);
    const TomlSource source{file};
    const TomlValue root(source, "", table);
    std::vector<std::string> keys = rateNames.all();
    keys.insert(keys.end(), {"name", "lanes"});
    root.only(keys);
    Card card{std::filesystem::path(file).stem().string(), root.get("name").text(), lanesOf(root.get("lanes"))};
    for (const auto& [rate, word] : rateNames.words) {
        const TomlValue given = root.get(word);
        card.rates.at(static_cast<std::size_t>(rate)) = given.only({"rate", "source"}).get("rate").positive();
        if (given.get("source").text().empty()) given.get("source").fail("is empty; say where the rate is stated");
    }
    return card;
}

const std::vector<Card>& cards() {
    static const std::vector<Card> all = builtInCards();
    return all;
}

const Card& cardNamed(const std::string& id) {
    std::vector<std::string> known;
    for (const Card& card : cards()) {
        if (card.id == id) return card;
        known.push_back(card.id);
    }
    throwUnknownWord("card", id, known);
}

} // namespace shadowbench::gpu
