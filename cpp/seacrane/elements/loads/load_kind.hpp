#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seacrane/elements/check.hpp"
#include "seacrane/elements/loads/load_list.hpp"

namespace seacrane {

struct CompiledLoads;
struct FlowStencil;
struct Followed;

/// What a load asks for while it is compiled.
class LoadContext {
 public:
  virtual ~LoadContext() = default;
  virtual Attachment attach(const std::string& body, const Vec3d& point) const = 0;
  virtual CoordinateData coordinate(const CoordinateDescription& d) const = 0;
  virtual int ground() const = 0;
  virtual double mass(const std::string& body) const = 0;
  virtual double gravity() const = 0;
  /// m: what errors of positions count over.
  virtual double length_scale() const = 0;
  /// The place of a state among those of all loads.
  virtual int state(LoadState state) = 0;
  /// The first of `count` slots of a zero-order-held input.
  virtual int input(const std::string& name, int count = 1) = 0;
  /// A place among the inertial tensions.
  virtual int inertial_tension() = 0;
  /// Of a stencil of points at which the load looks at the sea, see SeaView: equal ones have one number.
  virtual int stencil(const FlowStencil& stencil) = 0;
  /// What a load of a kind follows, of those that were compiled before.
  virtual Followed followed(const std::string& kind, const std::string& name) const = 0;
  virtual void lead(const std::string& as, const std::string& name, const Followed& signal) = 0;
};

/// What a load leads: the name of another whose kind says that it follows "as a winch".
struct Lead {
  std::string by;  // the load's own name
  const char* as;
  std::string name;
};

/// The described loads of one kind.
class DescribedLoads {
 public:
  const LoadKind& kind;

  explicit DescribedLoads(const LoadKind& of) : kind(of) {}
  virtual ~DescribedLoads() = default;
  virtual std::unique_ptr<DescribedLoads> copy() const = 0;
  virtual void add_example() = 0;
  virtual std::vector<std::string> names() const = 0;
  virtual void check(SceneNames& names) const = 0;
  virtual std::vector<Lead> leads() const = 0;
  /// The first load that is another one, or has another entry; empty: none.
  virtual std::string difference(const DescribedLoads& other) const = 0;
  virtual void compile(LoadContext& context, CompiledLoads& out) const = 0;
};

template <class Load>
struct DescribedAs : DescribedLoads {
  using DescribedLoads::DescribedLoads;
  std::vector<typename Load::Description> items;
};

/// What a kind of load says of itself, for those who treat all of them alike.
struct LoadKind {
  const char* name;
  const char* follows_as;  // what a heave compensator leads it as; empty: it follows nothing
  bool packs;              // apply() takes packs
  bool by_differences;     // apply() knows no scalar but double
  bool adds_inertia;       // to its bodies, before masses are factored
  std::unique_ptr<DescribedLoads> (*describe)();
};

/// As errors call a load: "contact 'feet'".
inline std::string name_of(const LoadList& list, LoadList::Place i) {
  return std::string(list.kind.name) + " '" + list.names[i] + "'";
}

/// The kind of a type of load, made in the object of that load alone.
template <class Load>
const LoadKind& load_kind();
/// All of them, in the order of their registration.
const std::vector<const LoadKind*>& load_kinds();
/// Null for an unknown one.
const LoadKind* find_load_kind(const std::string& name);

/// All described loads, a list for every kind.
struct LoadDescriptions {
  std::vector<Held<DescribedLoads>> lists;

  LoadDescriptions() {
    for (const LoadKind* kind : load_kinds()) lists.emplace_back(kind->describe());
  }
  template <class Load>
  std::vector<typename Load::Description>& of() const {
    for (const auto& list : lists) {
      if (&list->kind == &load_kind<Load>()) return static_cast<DescribedAs<Load>&>(*list).items;
    }
    throw std::logic_error(std::string(Load::kind) + " is not registered");
  }
};

/// All compiled loads: a list for each kind that there is, in the order of their registration.
struct CompiledLoads {
  std::vector<Held<LoadList>> lists;

  template <class Load>
  std::vector<Load>* find() const {
    for (const auto& list : lists) {
      if (&list->kind == &load_kind<Load>()) return &static_cast<LoadsOf<Load>&>(*list).items;
    }
    return nullptr;
  }
  template <class Load>
  const std::vector<Load>& of() const {
    static const std::vector<Load> none;
    const std::vector<Load>* const found = find<Load>();
    return found ? *found : none;
  }
  /// Calls f(list, place) for every load.
  template <class F>
  void for_each(F&& f) const {
    for (const auto& list : lists) {
      for (std::size_t i = 0; i < list->size(); ++i) f(*list, i);
    }
  }
};

}  // namespace seacrane
