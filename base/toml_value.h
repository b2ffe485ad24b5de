// Reading TOML with errors that name file, line and key. Only sources that read a TOML file include this: it brings toml++.
#pragma once

#include <glm/vec3.hpp>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <toml++/toml.h>
#include <vector>

namespace shadowbench {

/// What the values of one file share.
struct TomlSource {
    std::string file; // as named in errors
    /// A table whose keys are among `choices` gives one value for each; the one that counts is that of `chosen`.
    std::vector<std::string> choices{};
    std::string chosen{};
    double largest = std::numeric_limits<double>::max(); // size of a number
};

/// One value of the file with the dotted key that leads to it. Every accessor throws BadInput, `file:line: key: what is
/// wrong`.
class TomlValue {
public:
    /// A table whose keys are the source's choices stands for the value of the chosen one.
    TomlValue(const TomlSource& source, std::string key, const toml::node& node);

    [[nodiscard]] const std::string& key() const { return key_; }
    [[nodiscard]] std::string where() const; // "file:line: key", without a line where the program has made the value
    [[noreturn]] void fail(const std::string& sentence) const;

    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] std::string scalar() const; // a text, a number, or true or false, as a text
    std::string oneOf(const std::vector<std::string>& words) const;
    [[nodiscard]] double number() const; // finite, and no larger than the source allows
    [[nodiscard]] double positive() const;
    [[nodiscard]] int integer(int least, int most) const;
    [[nodiscard]] glm::dvec3 vector() const;
    [[nodiscard]] std::vector<TomlValue> list() const;
    [[nodiscard]] bool isList() const { return node_->is_array(); }
    [[nodiscard]] bool isWhole() const { return node_->is_integer(); } // written without a decimal point
    [[nodiscard]] bool isText() const { return node_->is_string(); }

    /// Fails on a key of this table that is not among `known`, with near matches.
    const TomlValue& only(const std::vector<std::string>& known) const;
    [[nodiscard]] std::vector<TomlValue> members() const;          // of a table, sorted by key
    [[nodiscard]] std::vector<TomlValue> membersAsWritten() const; // the same in the order of the file
    [[nodiscard]] std::optional<TomlValue> find(std::string_view name) const;
    TomlValue get(std::string_view name) const; // fails when missing
    [[nodiscard]] std::string_view lastKey() const;

private:
    [[nodiscard]] const toml::table& table() const;
    [[nodiscard]] TomlValue child(std::string_view name, const toml::node& node) const;
    [[nodiscard]] std::string got() const;

    const TomlSource* source_;
    std::string key_;
    const toml::node* node_;
};

/// The root table of a file's text. Throws BadInput with file and line when it is not TOML.
toml::table parseToml(std::string_view text, const std::string& file);

} // namespace shadowbench
