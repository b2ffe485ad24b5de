#include "tools/mutants/operators/operations.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace shadowbench::mutants {
namespace {

using Pair = std::pair<std::string_view, std::string_view>;

constexpr std::array<Pair, 6> opposites{{{"==", "!="}, {"!=", "=="}, {"<", ">="}, {">=", "<"}, {">", "<="}, {"<=", ">"}}};
constexpr std::array<Pair, 4> neighbours{{{"<", "<="}, {"<=", "<"}, {">", ">="}, {">=", ">"}}};
constexpr std::array<Pair, 4> otherSigns{{{"+", "-"}, {"+=", "-="}, {"-=", "+="}, {"*=", "/="}}};
constexpr std::array<Pair, 9> otherFunctions{{{"min", "max"},
                                              {"max", "min"},
                                              {"min_element", "max_element"},
                                              {"max_element", "min_element"},
                                              {"any_of", "all_of"},
                                              {"all_of", "any_of"},
                                              {"none_of", "any_of"},
                                              {"floor", "ceil"},
                                              {"ceil", "floor"}}};
constexpr std::array<std::string_view, 6> symmetric{"min", "max", "dot", "distance", "hypot", "swap"};

/// The second of the pair whose first is `key`; "" if there is none.
template <std::size_t count>
std::string_view second(const std::array<Pair, count>& pairs, std::string_view key) {
    const auto found = std::ranges::find(pairs, key, &Pair::first);
    return found == pairs.end() ? std::string_view() : found->second;
}

bool isSigned(Values values) { return values == Values::Signed || values == Values::Floating; }

} // namespace

std::vector<Change> changesOfBinary(const std::string& left, std::string_view sign, const std::string& right, Values values,
                                    bool alike) {
    std::vector<Change> changes;
    const auto replaced = [&](std::string_view by) { return fmt::format("{} {} {}", left, by, right); };
    if (const std::string_view by = second(opposites, sign); !by.empty())
        changes.push_back({"negated comparison", replaced(by)});
    if (const std::string_view by = second(neighbours, sign); !by.empty())
        changes.push_back({"shifted comparison", replaced(by)});
    if (sign == "&&" || sign == "||")
        for (const std::string& kept : {left, right})
            changes.push_back({"dropped term", fmt::format("static_cast<bool>({})", kept)});
    if (values == Values::Other) return changes;
    if (const std::string_view by = second(otherSigns, sign); !by.empty()) changes.push_back({"other sign", replaced(by)});
    if (alike && (sign == "+" || sign == "-" || sign == "*" || sign == "/")) changes.push_back({"dropped term", left});
    if (sign == "-" || sign == "/") changes.push_back({"swapped operands", fmt::format("{} {} {}", right, sign, left)});
    if (sign == "-" && isSigned(values))
        for (const char* absolute : {"std::abs({} - {})", "std::abs({}) - std::abs({})"})
            changes.push_back({"absolute value", fmt::format(fmt::runtime(absolute), left, right)});
    if ((sign == "*" || sign == "/") && values == Values::Floating)
        changes.push_back({"a tenth", fmt::format("{} {} {} * 0.1f", left, sign, right)});
    return changes;
}

std::vector<Change> changesOfLiteral(const std::string& literal, Values values) {
    if (literal == "true" || literal == "false") return {{"changed constant", literal == "true" ? "false" : "true"}};
    const bool isZero = literal.find_first_of("123456789") == std::string::npos;
    if (values == Values::Floating && !isZero) return {{"changed constant", "2 * " + literal}};
    return {{"changed constant", literal + " + 1"}};
}

std::vector<Change> changesOfCall(const std::string& function, const std::vector<std::string>& arguments,
                                  const std::vector<bool>& swaps, Values values, bool alike) {
    std::vector<Change> changes;
    const std::size_t colon = function.rfind(':');
    const std::string scope = colon == std::string::npos ? "" : function.substr(0, colon + 1);
    const std::string last = function.substr(scope.size());
    if (const std::string_view by = second(otherFunctions, last); !by.empty())
        changes.push_back({"other function", fmt::format("{}{}({})", scope, by, fmt::join(arguments, ", "))});
    if (last == "abs" && alike && isSigned(values)) changes.push_back({"absolute value", arguments.front()});
    if (std::ranges::count(symmetric, last) > 0) return changes;
    for (std::size_t i = 0; i + 1 < arguments.size(); ++i) {
        if (!swaps[i] || arguments[i] == arguments[i + 1]) continue;
        std::vector<std::string> swapped = arguments;
        std::swap(swapped[i], swapped[i + 1]);
        changes.push_back({"swapped arguments", fmt::format("{}({})", function, fmt::join(swapped, ", "))});
    }
    return changes;
}

} // namespace shadowbench::mutants
