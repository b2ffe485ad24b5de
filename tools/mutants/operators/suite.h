// The mutants that a seed draws from what judges, built into one copy of the tree, and the tests that run with each of them.
#pragma once

#include "tools/mutants/operators/point.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace shadowbench::mutants {

/// A part of the program that judges, and the programs of unit tests that have to detect what is wrong in it.
struct Judge {
    std::string name;
    std::vector<std::string> sources; // beginnings of paths from the root
    std::vector<std::string> programs;
};

/// What a run of the tests with a mutant tells.
enum class End { NotReached, Survives, Killed };

struct OperatorMutant {
    std::string id; // the same for as long as its line is
    std::size_t judge = 0;
    std::string file;
    std::size_t line = 0; // from 1
    std::string before;
    Point point;
    End end = End::NotReached;
};

const std::vector<Judge>& judges();

/// The points of a file as mutants, with ids that do not hang on the other lines of the file.
std::vector<OperatorMutant> mutantsOf(std::size_t judge, const std::string& file, const std::string& source,
                                      const std::vector<Point>& points);

/// All mutants in the order in which the seed draws them: that of one does not hang on which others there are.
void shuffle(std::vector<OperatorMutant>& mutants, std::uint64_t seed);

/// Why mutants survive that no test can kill, by id. Throws BadInput for what is no such list.
std::map<std::string, std::string> readSurvivors(const std::filesystem::path& file);

/// Markdown: the share that is killed over all and of each judge, and the survivors.
std::string operatorsReport(const std::vector<OperatorMutant>& mutants, const std::map<std::string, std::string>& why,
                            const std::string& source);

/// Of all that are drawn, those that are killed, in [0, 1].
double killedShare(const std::vector<OperatorMutant>& mutants);

} // namespace shadowbench::mutants
