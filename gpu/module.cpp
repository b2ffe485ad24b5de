#include "gpu/module.h"

#include "base/error.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <glslang/SPIRV/spirv.hpp>
#include <map>
#include <optional>
#include <span>
#include <spirv-tools/libspirv.hpp>
#include <stdexcept>
#include <utility>

namespace shadowbench::gpu {
namespace {

using Operands = std::span<const std::uint32_t>; // of an instruction, its own word first

void requireValid(const std::vector<std::uint32_t>& words, const std::string& name) {
    std::string reason;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
        if (reason.empty()) reason = message;
    });
    if (!tools.Validate(words))
        throw BadInput(
            fmt::format("{} is no valid SPIR-V for Vulkan 1.3: {}; make it by glslangValidator -V, or give the GLSL", name,
                        reason.empty() ? "it is damaged" : reason));
}

class Reader {
public:
    Reader(const std::vector<std::uint32_t>& words, const std::string& name) : name_(name) {
        for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) // behind the header
            read(Operands(words).subspan(at, words[at] >> 16));
    }

    Module module() {
        if (entries_ != 1) throw BadInput(fmt::format("{} has {} entry points; give modules of one each", name_, entries_));
        for (const auto& [id, variable] : variables_) add(id, variable);
        std::ranges::sort(module_.bindings, {}, [](const Binding& b) { return std::pair(b.set, b.number); });
        for (auto* side : {&module_.inputs, &module_.outputs}) std::ranges::sort(*side, {}, &Variable::location);
        return std::move(module_);
    }

private:
    struct Pointer {
        std::uint32_t type;
        spv::StorageClass storage;
    };

    void read(Operands words) {
        const auto operation = static_cast<spv::Op>(words[0] & 0xFFFF);
        switch (operation) {
        case spv::OpEntryPoint:
            ++entries_;
            module_.stage = stageOf(static_cast<spv::ExecutionModel>(words[1]));
            module_.entry = reinterpret_cast<const char*>(&words[3]);
            break;
        case spv::OpDecorate:
            decorations_[words[1]][static_cast<spv::Decoration>(words[2])] = words.size() > 3 ? words[3] : 0;
            break;
        case spv::OpMemberDecorate: // of a block of built-in variables
            if (words[3] == spv::DecorationBuiltIn) decorations_[words[1]][spv::DecorationBuiltIn] = words[4];
            break;
        case spv::OpConstant:
        case spv::OpSpecConstant:
            constants_[words[2]] = words[3];
            break;
        case spv::OpVariable:
            if (words[3] != spv::StorageClassFunction && words[3] != spv::StorageClassPrivate)
                variables_.emplace_back(words[2], Pointer{pointees_[words[1]], static_cast<spv::StorageClass>(words[3])});
            break;
        case spv::OpTypePointer:
            pointees_[words[1]] = words[3];
            break;
        default:
            if (operation >= spv::OpTypeVoid && operation < spv::OpTypePointer) types_[words[1]] = words;
        }
    }

    [[nodiscard]] Stage stageOf(spv::ExecutionModel model) const {
        switch (model) {
        case spv::ExecutionModelVertex:
            return Stage::Vertex;
        case spv::ExecutionModelFragment:
            return Stage::Fragment;
        case spv::ExecutionModelGLCompute:
            return Stage::Compute;
        default:
            throw BadInput(name_ + " is of another stage than vertex, fragment and compute, which alone are compiled");
        }
    }

    [[nodiscard]] std::optional<std::uint32_t> decoration(std::uint32_t id, spv::Decoration what) const {
        const auto known = decorations_.find(id);
        if (known == decorations_.end()) return {};
        const auto found = known->second.find(what);
        return found == known->second.end() ? std::nullopt : std::optional(found->second);
    }

    void add(std::uint32_t id, Pointer variable) {
        if (variable.storage == spv::StorageClassPushConstant) module_.pushConstants = true;
        if (decoration(id, spv::DecorationBinding)) return addBinding(id, variable);
        const bool input = variable.storage == spv::StorageClassInput;
        if (!input && variable.storage != spv::StorageClassOutput) return;
        if (decoration(id, spv::DecorationBuiltIn) || decoration(variable.type, spv::DecorationBuiltIn)) return;
        unsigned location = decoration(id, spv::DecorationLocation).value_or(0);
        addLocations(variable.type, location, input ? module_.inputs : module_.outputs);
    }

    void addBinding(std::uint32_t id, Pointer variable) {
        Binding binding{decoration(id, spv::DecorationDescriptorSet).value_or(0), *decoration(id, spv::DecorationBinding),
                        Resource::UniformBuffer};
        Operands type = types_.at(variable.type);
        while (isA(type, spv::OpTypeArray) || isA(type, spv::OpTypeRuntimeArray)) {
            if (isA(type, spv::OpTypeArray)) binding.count *= constants_.at(type[3]);
            type = types_.at(type[2]);
        }
        binding.resource = resourceOf(type, variable.storage);
        module_.bindings.push_back(binding);
    }

    [[nodiscard]] Resource resourceOf(Operands type, spv::StorageClass storage) const {
        if (isA(type, spv::OpTypeSampledImage))
            return types_.at(type[2])[3] == spv::DimBuffer ? Resource::UniformTexels : Resource::SampledImage;
        if (isA(type, spv::OpTypeSampler)) return Resource::Sampler;
        if (isA(type, spv::OpTypeImage)) {
            const bool written = type[7] == 2;
            if (type[3] == spv::DimSubpassData)
                throw BadInput(name_ + " reads an input attachment; read it as a texture instead");
            if (type[3] == spv::DimBuffer) return written ? Resource::StorageTexels : Resource::UniformTexels;
            return written ? Resource::StorageImage : Resource::Image;
        }
        const bool stored = storage == spv::StorageClassStorageBuffer || decoration(type[1], spv::DecorationBufferBlock);
        return stored ? Resource::StorageBuffer : Resource::UniformBuffer;
    }

    /// `location` becomes the one behind the type.
    void addLocations(std::uint32_t id, unsigned& location, std::vector<Variable>& side) const {
        const Operands type = types_.at(id);
        if (isA(type, spv::OpTypeArray) || isA(type, spv::OpTypeMatrix)) {
            const unsigned count = isA(type, spv::OpTypeArray) ? constants_.at(type[3]) : type[3];
            for (unsigned i = 0; i < count; ++i) addLocations(type[2], location, side);
        } else if (isA(type, spv::OpTypeStruct)) {
            for (const std::uint32_t member : type.subspan(2)) addLocations(member, location, side);
        } else {
            const bool vector = isA(type, spv::OpTypeVector);
            side.push_back({location++, scalarOf(vector ? types_.at(type[2]) : type), vector ? type[3] : 1});
        }
    }

    [[nodiscard]] Scalar scalarOf(Operands type) const {
        if (type.size() > 2 && type[2] == 64) throw BadInput(name_ + " has an input or output of 64 bits; use 32");
        if (isA(type, spv::OpTypeFloat)) return Scalar::Float;
        return type[3] != 0 ? Scalar::Int : Scalar::Uint;
    }

    static bool isA(Operands type, spv::Op operation) { return (type[0] & 0xFFFF) == static_cast<unsigned>(operation); }

    const std::string& name_;
    Module module_{};
    int entries_ = 0;
    std::map<std::uint32_t, std::map<spv::Decoration, std::uint32_t>> decorations_;
    std::map<std::uint32_t, std::uint32_t> constants_, pointees_;
    std::map<std::uint32_t, Operands> types_;
    std::vector<std::pair<std::uint32_t, Pointer>> variables_;
};

} // namespace

Module readModule(const std::vector<std::uint32_t>& words, const std::string& name) {
    requireValid(words, name);
    try {
        return Reader(words, name).module();
    } catch (const std::out_of_range&) { // of what it uses, something was not read
        throw BadInput(name + " declares a resource, input or output of a type that is not known here; leave it out");
    }
}

} // namespace shadowbench::gpu
