// The operators: what stands instead of an expression in its mutants.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace shadowbench::mutants {

enum class Values { Unsigned, Signed, Floating, Vector, Other }; // Vector: of glm, as is a matrix

struct Change {
    std::string operation, after;
};

/// Of `left` `sign` `right`; `values` are those of the result, or of the operands where they are compared. `alike`: the
/// result has the left operand's type.
std::vector<Change> changesOfBinary(const std::string& left, std::string_view sign, const std::string& right, Values values,
                                    bool alike);

std::vector<Change> changesOfLiteral(const std::string& literal, Values values);

/// Of a call of `function`, named as in the source, with arguments of which each that `swaps` marks can stand where the next
/// one does. `values` are those of the result, `alike` as above with the first argument.
std::vector<Change> changesOfCall(const std::string& function, const std::vector<std::string>& arguments,
                                  const std::vector<bool>& swaps, Values values, bool alike);

} // namespace shadowbench::mutants
