// A folder in which verbs of the program are run, harmed, and run again: everything they need is there before, and what they
// leave is checked.
#pragma once

#include "base/temporary_folder.h"
#include "tools/faults/supervised.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::faults {

/// A verb with what it is given. Files are named from the sandbox's folder, in which it starts.
struct Verb {
    std::string name;
    std::vector<std::string> arguments; // the verb's own name first
    std::string out;                    // folder that it writes
    std::string records;                // file of records in it; "": none
    std::vector<std::string> keeps;     // rows, by technique, that are in the records before it starts
};

/// The verbs that write, on a scene of a few pixels.
std::vector<Verb> writingVerbs();

/// The ones with these names, in the order of the names; all for none. Throws BadInput naming one that there is not.
std::vector<Verb> verbsNamed(const std::vector<std::string>& names);

class Sandbox {
public:
    /// Makes what the verbs need by `program`; `verbs` are run once, undisturbed, which says what they should leave. Throws
    /// InternalError naming a verb that fails undisturbed.
    Sandbox(std::filesystem::path program, const std::vector<Verb>& verbs);

    [[nodiscard]] const std::filesystem::path& folder() const { return work_; }

    /// As it was before any verb was run.
    void reset();

    [[nodiscard]] Ended run(const Verb& verb, const Decide& decide, const std::vector<std::string>& variables = {}) const;
    /// Without a supervisor's ado, as many as one likes at a time.
    [[nodiscard]] Ended runPlain(const std::vector<std::string>& arguments) const;

    /// What is wrong with the files that are there, a sentence each: partial ones, and temporary ones unless `killed`.
    [[nodiscard]] std::vector<std::string> damage(bool killed) const;
    /// Temporary folders that are left.
    [[nodiscard]] std::vector<std::string> leftFolders() const;
    /// Why the verb's records and files are not those of an undisturbed run, but for times; nothing if they are.
    [[nodiscard]] std::optional<std::string> difference(const Verb& verb) const;
    /// Which of the rows that were there before the verb are gone.
    [[nodiscard]] std::vector<std::string> lostRows(const Verb& verb) const;
    /// A text without the sandbox's own path.
    [[nodiscard]] std::string shown(std::string text) const;

private:
    [[nodiscard]] std::vector<std::string> environment() const;
    void prepare(const std::vector<std::string>& arguments) const;

    std::filesystem::path program_;
    TemporaryFolder folder_;
    std::filesystem::path work_, before_; // the second: a copy of what is there before any verb is run
    struct Expected {
        std::vector<std::string> records, files;
    };
    std::map<std::string, Expected> expected_; // by verb
};

} // namespace shadowbench::faults
