#include "harness/foreign/renderer.h"

#include "base/error.h"
#include "base/files.h"
#include "base/shell_word.h"
#include "base/toml_value.h"
#include "base/words.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sstream>

namespace shadowbench::foreign {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono;

const std::vector<std::string> keys = {"id",         "title",    "source",      "command",         "definition", "encoding",
                                       "channel",    "depth_is", "history",     "leave_out_edges", "force",      "frames",
                                       "time_limit", "settings", "environment", "means",           "as_it_is",   "arguments",
                                       "lights",     "division", "advice"};
const std::vector<std::string> placeholders = {"scene", "frames", "out"};

std::string textOf(const toml::node& entry) {
    std::ostringstream text;
    text << toml::toml_formatter(*entry.as_table());
    return text.str();
}

std::string idIn(const TomlValue& value) {
    std::string id = value.text();
    const auto isAllowed = [](unsigned char c) {
        return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '.' || c == '_' || c == '-';
    };
    if (id.empty() || !std::ranges::all_of(id, isAllowed) || id.front() == '.' || id.front() == '-')
        value.fail(
            fmt::format("\"{}\" cannot be an id: it is made of lower-case letters, digits, \"_\", \".\" and \"-\", and "
                        "begins with one of the first three",
                        id));
    return id;
}

/// The placeholders of a word, without braces: {a}, but not ${a}, which is the shell's.
std::vector<std::string> placeholdersIn(const std::string& word) {
    std::vector<std::string> found;
    for (std::size_t open = word.find('{'); open != std::string::npos; open = word.find('{', open + 1)) {
        const std::size_t close = word.find('}', open);
        if (close == std::string::npos) break;
        std::string name = word.substr(open + 1, close - open - 1);
        const bool isName = !name.empty() && std::ranges::all_of(name, [](unsigned char c) { return std::islower(c) != 0; });
        if (isName && (open == 0 || word[open - 1] != '$')) found.push_back(std::move(name));
    }
    return found;
}

void requirePlaceholders(const TomlValue& value, const std::vector<std::string>& words) {
    std::vector<std::string> found;
    for (const std::string& word : words) std::ranges::move(placeholdersIn(word), std::back_inserter(found));
    for (const std::string& name : found)
        if (std::ranges::find(placeholders, name) == placeholders.end())
            value.fail(fmt::format("there is no placeholder {{{}}}{}; there are {{scene}}, {{frames}} and {{out}}", name,
                                   didYouMean(name, placeholders)));
    for (const char* needed : {"scene", "out"})
        if (std::ranges::find(found, needed) == found.end())
            value.fail(fmt::format("{{{}}} is missing: the command learns nowhere else {}", needed,
                                   std::string_view(needed) == "scene" ? "where the exported scene is"
                                                                       : "where to write its images"));
}

std::vector<std::string> commandIn(const TomlValue& value) {
    std::vector<std::string> words;
    if (value.isText()) {
        words = {"/bin/sh", "-c", value.text()};
    } else {
        for (const TomlValue& word : value.list()) words.push_back(word.text());
        if (words.empty() || words.front().empty()) value.fail("is empty: it begins with the program to run");
    }
    requirePlaceholders(value, words);
    return words;
}

/// What a renderer adds to a command that several share.
void addArguments(const TomlValue& value, Renderer& renderer) {
    if (renderer.isShellLine) value.fail("is for a command that is a list of words, and `command` is a line for the shell");
    for (const TomlValue& word : value.list()) renderer.command.push_back(word.text());
}

std::vector<LightKind> lightsIn(const TomlValue& value) {
    std::vector<std::string> names;
    for (int kind = 0; kind <= static_cast<int>(LightKind::Environment); ++kind)
        names.emplace_back(name(static_cast<LightKind>(kind)));
    std::vector<LightKind> lights;
    for (const TomlValue& word : value.list())
        lights.push_back(static_cast<LightKind>(std::ranges::find(names, word.oneOf(names)) - names.begin()));
    if (lights.empty()) value.fail("is empty: name a kind of light, or leave it out for all");
    return lights;
}

/// A tuned row says who recommends its settings, and no other one needs to.
void readDivision(const TomlValue& entry, Renderer& renderer) {
    const std::vector<std::string> names{"defaults", "equal-maps", "tuned"};
    if (const auto value = entry.find("division"))
        renderer.division = static_cast<Division>(std::ranges::find(names, value->oneOf(names)) - names.begin());
    if (const auto value = entry.find("advice")) renderer.advice = value->text();
    if ((renderer.division == Division::Tuned) == renderer.advice.empty())
        entry.get("id").fail("a row of the division \"tuned\" has `advice`, the sentence of the engine's documents that "
                             "recommends its settings, and no other row has");
}

std::vector<std::pair<std::string, std::string>> settingsIn(const TomlValue& table) {
    std::vector<std::pair<std::string, std::string>> settings;
    for (const TomlValue& value : table.members()) settings.emplace_back(value.lastKey(), value.scalar());
    return settings;
}

std::vector<std::pair<std::string, std::string>> variablesIn(const TomlValue& table) {
    std::vector<std::pair<std::string, std::string>> variables;
    for (const TomlValue& value : table.members()) variables.emplace_back(value.lastKey(), value.text());
    return variables;
}

/// The value of `key`, which is still read by its former name.
std::optional<TomlValue> findRenamed(const TomlValue& entry, const char* key, const char* former) {
    if (const auto value = entry.find(key)) return value;
    const std::optional<TomlValue> value = entry.find(former);
    if (value) fmt::print(stderr, "{} is now called {}\n", value->where(), key);
    return value;
}

/// What the images say, and how.
void readMeaning(const TomlValue& entry, Renderer& renderer) {
    if (const auto value = findRenamed(entry, "definition", "means"))
        renderer.definition = definitionNamed(value->oneOf({"hard", "area", "irradiance", "solid-angle"}));
    if (const auto value = entry.find("encoding"))
        renderer.encoding = value->oneOf({"linear", "srgb"}) == "srgb" ? Encoding::Srgb : Encoding::Linear;
    if (const auto value = entry.find("channel")) renderer.channel = value->text();
    if (const auto value = entry.find("depth_is"))
        renderer.depth = value->oneOf({"z", "distance"}) == "distance" ? Depth::FromEye : Depth::AlongView;
    if (const auto value = entry.find("history")) renderer.remembers = value->boolean();
    if (const auto value = entry.find("leave_out_edges")) renderer.leaveOutEdges = value->boolean();
    if (const auto value = findRenamed(entry, "force", "as_it_is")) renderer.force = value->boolean();
}

Renderer rendererIn(const TomlValue& entry) {
    entry.only(keys);
    Renderer renderer;
    renderer.id = idIn(entry.get("id"));
    renderer.command = commandIn(entry.get("command"));
    renderer.isShellLine = entry.get("command").isText();
    if (const auto value = entry.find("arguments")) addArguments(*value, renderer);
    if (const auto value = entry.find("lights")) renderer.lights = lightsIn(*value);
    readDivision(entry, renderer);
    if (const auto value = entry.find("title")) renderer.title = value->text();
    if (const auto value = entry.find("source")) renderer.source = value->text();
    readMeaning(entry, renderer);
    if (const auto value = entry.find("frames")) renderer.moving = value->oneOf({"all", "still"}) == "all";
    if (const auto value = entry.find("time_limit"))
        renderer.limit = milliseconds(static_cast<std::int64_t>(1000 * std::min(value->positive(), 86400.0 * 7)));
    if (const auto value = entry.find("settings")) renderer.settings = settingsIn(*value);
    if (const auto value = entry.find("environment")) renderer.environment = variablesIn(*value);
    return renderer;
}

/// Gives each renderer the keys of [shared] that it does not say itself.
void share(toml::table& root, const TomlValue& whole) {
    const auto shared = whole.find("shared");
    if (!shared) return;
    std::vector<std::string> known = keys;
    std::erase(known, "id");
    shared->only(known);
    const toml::array* list = root.get("renderer") != nullptr ? root.get("renderer")->as_array() : nullptr;
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
        if (toml::table* entry = (*root.get("renderer")->as_array())[i].as_table())
            for (const auto& [key, value] : *root.get("shared")->as_table()) entry->insert(key, value);
}

} // namespace

bool Renderer::draws(LightKind kind) const { return lights.empty() || std::ranges::find(lights, kind) != lights.end(); }

std::optional<Client> readClient(const fs::path& file) {
    const toml::table root = parseToml(readFile(file), file.string());
    const TomlSource source{.file = file.string()};
    const auto table = TomlValue(source, "", root).find("client");
    if (!table) return {};
    table->only({"engine", "version", "maintainer", "retired"});
    Client client{table->get("engine").text(), table->get("version").text(), table->get("maintainer").text()};
    if (const auto retired = table->find("retired")) client.retired = retired->text();
    return client;
}

std::vector<Renderer> readRenderers(const fs::path& file) {
    const std::string text = readFile(file);
    toml::table root = parseToml(text, file.string());
    const TomlSource source{.file = file.string()};
    const TomlValue whole(source, "", root);
    whole.only({"client", "shared", "renderer", "expect"});
    share(root, whole);
    const TomlValue list = whole.get("renderer");
    std::vector<Renderer> renderers;
    const toml::array* nodes = root.get("renderer")->as_array();
    for (const TomlValue& entry : list.list()) {
        Renderer renderer = rendererIn(entry);
        renderer.text = textOf(*nodes->get(renderers.size()));
        renderer.line = static_cast<int>(nodes->get(renderers.size())->source().begin.line);
        renderer.folder = fs::absolute(file).parent_path();
        if (std::ranges::find(renderers, renderer.id, &Renderer::id) != renderers.end())
            entry.get("id").fail(fmt::format("there is another renderer \"{}\" above", renderer.id));
        renderers.push_back(std::move(renderer));
    }
    if (renderers.empty()) list.fail("is empty: describe a renderer under [[renderer]]");
    return renderers;
}

std::string filledIn(std::string text, const std::vector<std::pair<std::string, std::string>>& values, bool quoted) {
    std::string filled;
    for (std::size_t at = 0; at < text.size();) {
        const auto stands = std::ranges::find_if(values, [&](const auto& value) {
            return text.compare(at, value.first.size() + 2, "{" + value.first + "}") == 0 &&
                   (at == 0 || text[at - 1] != '$');
        });
        if (stands == values.end()) {
            filled += text[at++];
            continue;
        }
        filled += quoted ? shellWord(stands->second) : stands->second;
        at += stands->first.size() + 2;
    }
    return filled;
}

} // namespace shadowbench::foreign
