// Declared parameters of a technique, and variant strings such as "pcss:taps=32+32,map=1024".
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace shadowbench::techniques {

struct IntegerRange {
    int low, high;
};
struct RealRange {
    double low, high;
};
struct OneOf {
    std::vector<std::string> values;
};
using Domain = std::variant<IntegerRange, RealRange, OneOf>;

/// "64…8192", "none|constant|slope".
std::string describe(const Domain& domain);

struct Parameter {
    std::string name;
    std::string defaultValue;
    Domain domain;
    std::string meaning; // one line, with the unit
    std::string source;  // where the document gives the parameter or its default; empty if it is ours
};

/// Values for all declared parameters of one technique, in declared order.
class Parameters {
public:
    explicit Parameters(std::vector<std::pair<std::string, std::string>> values) : values_(std::move(values)) {}

    [[nodiscard]] int integer(std::string_view name) const;
    [[nodiscard]] double real(std::string_view name) const;
    [[nodiscard]] const std::string& text(std::string_view name) const;
    [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& all() const { return values_; }

private:
    std::vector<std::pair<std::string, std::string>> values_;
};

/// Parses "name=value,…" against the declarations. Throws BadInput naming `technique`, the offending word and the valid
/// ones.
Parameters parseParameters(std::string_view assignments, const std::vector<Parameter>& declared,
                           const std::string& technique);

/// "id" or "id:name=value,…": declared order, defaults left out.
std::string canonicalVariant(const std::string& id, const Parameters& parameters, const std::vector<Parameter>& declared);

} // namespace shadowbench::techniques
