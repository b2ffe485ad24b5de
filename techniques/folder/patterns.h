// The sampling patterns of a technique folder, as its shaders read them.
#pragma once

#include "techniques/folder/description.h"
#include "techniques/gl/program.h"
#include "techniques/shared/filters/jitter_table.h"

#include <map>
#include <string>

namespace shadowbench::techniques {

class FolderPatterns {
public:
    FolderPatterns(const TechniqueFolder& folder, const Parameters& values);

    /// Sets the uniform if a pattern has its name: an array as long as the shader declares it, or a table.
    void set(gl::Program& program, const std::string& name, const Light& light) const;

private:
    std::map<std::string, PatternKind> kinds_;
    std::map<std::string, double> sigmas_; // of Gaussians
    std::map<std::string, JitterTable> tables_;
};

/// The type of the uniform of such a pattern.
std::string typeOf(PatternKind kind);

} // namespace shadowbench::techniques
