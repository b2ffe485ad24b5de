#include "base/toml_value.h"

#include "base/error.h"
#include "base/one_line.h"
#include "base/words.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench {
namespace {

bool isChoice(const TomlSource& source, const toml::node& node) {
    const toml::table* table = node.as_table();
    const auto holds = [&](const std::string& choice) { return table->contains(choice); };
    return table != nullptr && std::any_of(source.choices.begin(), source.choices.end(), holds);
}

} // namespace

TomlValue::TomlValue(const TomlSource& source, std::string key, const toml::node& node)
    : source_(&source), key_(std::move(key)), node_(&node) {
    if (key_.empty() || !isChoice(source, node)) return; // the file as a whole is none
    only(source.choices);
    const toml::node* chosen = table().get(source.chosen);
    if (chosen == nullptr) fail(fmt::format("has no value for profile {}", source.chosen));
    node_ = chosen;
}

std::string TomlValue::where() const {
    const unsigned line = node_->source().begin.line;
    return line == 0 ? fmt::format("{}: {}", source_->file, key_) : fmt::format("{}:{}: {}", source_->file, line, key_);
}

void TomlValue::fail(const std::string& sentence) const {
    // The file itself has no key to name.
    const std::string place = key_.empty() ? source_->file + ":1" : where();
    throw BadInput(onOneLine(fmt::format("{}: {}", place, sentence))); // words of the file may hold a byte 0, too
}

std::string TomlValue::got() const {
    if (const auto* text = node_->as_string()) return fmt::format("\"{}\"", text->get());
    if (const auto* integer = node_->as_integer()) return fmt::format("{}", integer->get());
    if (const auto* number = node_->as_floating_point()) return fmt::format("{}", number->get());
    if (const auto* flag = node_->as_boolean()) return flag->get() ? "true" : "false";
    if (const auto* list = node_->as_array()) return fmt::format("a list of {}", list->size());
    return node_->is_table() ? "a table" : "a date or time";
}

bool TomlValue::boolean() const {
    if (!node_->is_boolean()) fail(fmt::format("expected true or false, got {}", got()));
    return node_->as_boolean()->get();
}

std::string TomlValue::text() const {
    if (!node_->is_string()) fail(fmt::format("expected a text in quotes, got {}", got()));
    return node_->as_string()->get();
}

std::string TomlValue::scalar() const {
    if (node_->is_string()) return text();
    if (!node_->is_number() && !node_->is_boolean())
        fail(fmt::format("expected a text, a number, true or false, got {}", got()));
    return got();
}

std::string TomlValue::oneOf(const std::vector<std::string>& words) const {
    std::string word = text();
    if (std::find(words.begin(), words.end(), word) == words.end())
        fail(fmt::format("expected one of {}, got \"{}\"{}", fmt::join(words, ", "), word, didYouMean(word, words)));
    return word;
}

double TomlValue::number() const {
    if (!node_->is_number()) fail(fmt::format("expected a number, got {}", got()));
    // Not value<double>(), which is empty for whole numbers that a double rounds.
    const auto* whole = node_->as_integer();
    const double value = whole != nullptr ? static_cast<double>(whole->get()) : node_->as_floating_point()->get();
    if (!std::isfinite(value)) fail(fmt::format("expected a finite number, got {}", got()));
    if (std::abs(value) > source_->largest)
        fail(fmt::format("expected a number of at most {:g} in size, got {}", source_->largest, got()));
    return value;
}

double TomlValue::positive() const {
    const double value = number();
    if (!(value > 0)) fail(fmt::format("expected a number above 0, got {}", got()));
    return value;
}

int TomlValue::integer(int least, int most) const {
    if (!node_->is_integer()) fail(fmt::format("expected a whole number, got {}", got()));
    const std::int64_t value = node_->as_integer()->get();
    if (value < least || value > most)
        fail(fmt::format("expected a whole number from {} to {}, got {}", least, most, value));
    return static_cast<int>(value);
}

glm::dvec3 TomlValue::vector() const {
    if (!node_->is_array() || node_->as_array()->size() != 3) fail(fmt::format("expected 3 numbers, got {}", got()));
    const std::vector<TomlValue> values = list();
    return {values[0].number(), values[1].number(), values[2].number()};
}

std::vector<TomlValue> TomlValue::list() const {
    if (!node_->is_array()) fail(fmt::format("expected a list, got {}", got()));
    std::vector<TomlValue> values;
    for (const toml::node& element : *node_->as_array())
        values.emplace_back(*source_, fmt::format("{}[{}]", key_, values.size() + 1), element);
    return values;
}

const toml::table& TomlValue::table() const {
    if (!node_->is_table()) fail(fmt::format("expected a table {{ … }}, got {}", got()));
    return *node_->as_table();
}

TomlValue TomlValue::child(std::string_view name, const toml::node& node) const {
    return {*source_, key_.empty() ? std::string(name) : fmt::format("{}.{}", key_, name), node};
}

const TomlValue& TomlValue::only(const std::vector<std::string>& known) const {
    for (const auto& [key, node] : table()) {
        if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
        const std::string near = didYouMean(key.str(), known);
        const std::string path = key_.empty() ? std::string(key.str()) : fmt::format("{}.{}", key_, key.str());
        throw BadInput(fmt::format("{}:{}: {}: unknown key{}", source_->file, key.source().begin.line, path,
                                   near.empty() ? fmt::format("; known are {}", fmt::join(known, ", ")) : near));
    }
    return *this;
}

std::vector<TomlValue> TomlValue::members() const {
    std::vector<TomlValue> values;
    for (const auto& [key, node] : table()) values.push_back(child(key.str(), node));
    return values;
}

std::vector<TomlValue> TomlValue::membersAsWritten() const {
    std::vector<TomlValue> values = members();
    const auto place = [](const TomlValue& value) {
        const toml::source_position begin = value.node_->source().begin;
        return std::pair(begin.line, begin.column);
    };
    std::ranges::stable_sort(values, {}, place);
    return values;
}

std::optional<TomlValue> TomlValue::find(std::string_view name) const {
    const toml::node* node = table().get(name);
    if (node == nullptr) return std::nullopt;
    return child(name, *node);
}

TomlValue TomlValue::get(std::string_view name) const {
    std::optional<TomlValue> value = find(name);
    if (value) return *value;
    const std::string path = key_.empty() ? std::string(name) : fmt::format("{}.{}", key_, name);
    throw BadInput(
        fmt::format("{}:{}: {}: missing", source_->file, std::max<unsigned>(1, node_->source().begin.line), path));
}

std::string_view TomlValue::lastKey() const { return std::string_view(key_).substr(key_.rfind('.') + 1); }

toml::table parseToml(std::string_view text, const std::string& file) {
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        throw BadInput(fmt::format("{}:{}: not valid TOML: {}", file, error.source().begin.line,
                                   onOneLine(std::string(error.description()))));
    }
}

} // namespace shadowbench
