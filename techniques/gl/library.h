// A shared library that is opened while the program runs, so that the program starts without it.
#pragma once

#include <string>

namespace shadowbench::gl {

class Library {
public:
    /// Opens `name`, or the file that the environment variable `variable` names instead. Look at `whyNot` before `function`.
    Library(const std::string& name, const char* variable);

    /// Why it did not open, as the loader says it; empty where it did.
    [[nodiscard]] const std::string& whyNot() const { return whyNot_; }

    /// Throws Inconclusive when the library has no such function.
    template <typename Function>
    [[nodiscard]] Function function(const char* name) const {
        return reinterpret_cast<Function>(address(name));
    }

private:
    [[nodiscard]] void* address(const char* name) const;

    std::string name_, whyNot_;
    void* handle_ = nullptr; // never closed: drivers leave functions behind that run at the end of threads
};

} // namespace shadowbench::gl
