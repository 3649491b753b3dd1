#include "bindings.hpp"
#include "description.hpp"
#include "load_binding.hpp"
#include "seacrane/elements/joints/joint_kinds.hpp"
#include "seacrane/elements/loads/registry.hpp"

using namespace seacrane;

namespace {

void bind_fields(py::module_& m) {
  using description::FieldRow;
  py::class_<FieldRow>(m, "Field", "An entry of an element: what FIELDS of its class lists.")
      .def_readonly("name", &FieldRow::name)
      .def_readonly("type", &FieldRow::type,
                    "text, texts, number, flag, array, curve, frame, function or object")
      .def_readonly("role", &FieldRow::role, "name, body, joint, coordinate, distance or value")
      .def_readonly("unit", &FieldRow::unit)
      .def_readonly("text", &FieldRow::text)
      .def_readonly("shape", &FieldRow::shape, "of an array; -1: any length")
      .def_readonly("required", &FieldRow::required)
      .def_readonly("default", &FieldRow::usual, "where it is not required")
      .def_readonly("bounds", &FieldRow::bounds,
                    "what its numbers must be, in the words of JSON Schema: minimum, exclusiveMinimum, ...")
      .def_readonly("least", &FieldRow::least, "usual magnitude of what is not zero; 0: no bound")
      .def_readonly("most", &FieldRow::most, "likewise");
}

/// A getter that copies, one function for all members of a type.
template <class T, class V>
auto copied(V T::*member) {
  return [member](const T& self) { return self.*member; };
}

/// The joint types, and what they say of themselves.
void bind_joint_kinds(py::module_& m) {
  using description::FieldRow;
  py::class_<JointKind>(m, "JointKind", "What a joint type says of itself; see joint_kinds().")
      .def_readonly("name", &JointKind::name)
      .def_readonly("rows", &JointKind::rows, "constraints")
      .def_property_readonly(
          "coordinates", [](const JointKind& k) { return py::str(k.coordinates).attr("split")(); },
          "those it offers")
      .def_readonly("usual", &JointKind::usual, "the coordinate meant where none is named; may be empty")
      .def_readonly("slides", &JointKind::slides, "whether its reaction is taken on the first body")
      .def_readonly("own_axis", &JointKind::own_axis, "whether the axis on the second body is another one")
      .def_readonly("own_point", &JointKind::own_point, "whether the point on the second body is another one")
      .def_readonly("branch", &JointKind::branch, "whether formulation 'recursive' may step it")
      .def_property_readonly(
          "parameters",
          [](const JointKind& k) {
            py::list out;
            for (const JointKind::Parameter& p : k.parameters) {
              out.append(FieldRow{p.name, "number", description::text_of(p.role), p.unit, p.text, py::tuple(),
                                  p.required,
                                  p.required ? py::object(py::none()) : py::object(py::float_(p.usual)),
                                  description::in_words(p.bound)});
            }
            return py::tuple(out);
          },
          "numbers of its own, (Field, ...)")
      .def(
          "example",
          [](const JointKind& k, std::uint64_t seed) {
            Random random(seed);
            return k.example(random);
          },
          py::arg("seed"), "A closed joint of bodies 'first' and 'second' at one pose, with random frames.");
  m.def(
      "joint_kinds",
      [] {
        py::dict out;
        for (const JointKind& kind : joint_kinds()) out[kind.name.c_str()] = kind;
        return out;
      },
      "The joint types by name.");
}

void bind_joint(py::module_& m) {
  description::bind<Frame>(m, "frame");
  description::bind<JointDescription>(m, "joint", ", **parameters: typing.SupportsFloat")
      .def_readonly("parameters", &JointDescription::parameters,
                    "The kind's own numbers by name, such as the length of a distance joint (copy).")
      .def(
          "__getattr__",
          [](const JointDescription& d, const std::string& name) {
            const auto found = d.parameters.find(name);
            if (found != d.parameters.end()) return found->second;
            if (const JointKind* const kind = find_joint_kind(d.kind)) {
              for (const JointKind::Parameter& p : kind->parameters) {
                if (p.name == name && !p.required) return p.usual;
              }
            }
            throw py::attribute_error("joint '" + d.name + "' is " + d.kind + " and has no '" + name + "'");
          },
          py::arg("name"), "A parameter by its name, or its default.");
}

/// In the order of their registration.
std::vector<const LoadBinding*> load_bindings() {
  return []<class... Load>(std::type_identity<std::tuple<Load...>>) {
    return std::vector<const LoadBinding*>{&load_binding<Load>()...};
  }(std::type_identity<LoadTypes>{});
}

void bind_loads(py::module_& m) {
  py::dict kinds;
  const std::vector<const LoadBinding*> bindings = load_bindings();
  for (std::size_t i = 0; i < bindings.size(); ++i) kinds[load_kinds()[i]->name] = bindings[i]->bind(m);
  auto limit = description::bind<LimitDescription>(m, "limit");
  limit.attr("STIFF") = false;
  limit.attr("OWN_PACE") = false;
  limit.attr("PASSIVE") = true;
  limit.attr("HOLDS") = false;
  limit.attr("DRAWN") = "";
  limit.attr("PROPORTIONS") = py::tuple();
  kinds["limit"] = limit;
  m.attr("LOAD_KINDS") = kinds;
}

void bind_retardation(py::module_& m) {
  using R = RetardationFunctions;
  using Samples = py::array_t<double, py::array::c_style | py::array::forcecast>;
  py::class_<R>(
      m, "RetardationFunctions",
      "Fluid memory by direct convolution, mu_j(t) = sum_k integral K_jk(tau) v_k(t - tau) dtau: kernel "
      "(n, 6, 6) at tau = 0, step, 2 step ... in s, cubic in between, zero beyond. Motions 0 (surge) ... "
      "5 (yaw); the motion is sampled at the same step.")
      .def(py::init([](double step, const Samples& kernel) {
             if (kernel.ndim() != 3 || kernel.shape(1) != 6 || kernel.shape(2) != 6) {
               throw std::invalid_argument("retardation functions: the kernel must have shape (n, 6, 6)");
             }
             R out{step, std::vector<Mat6d>(static_cast<std::size_t>(kernel.shape(0)))};
             const double* at = kernel.data();
             for (Mat6d& sample : out.kernel) {
               sample = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(at);
               at += 36;
             }
             return out;
           }),
           py::kw_only(), py::arg("step"), py::arg("kernel"))
      .def_readonly("step", &R::step, "s")
      .def_property_readonly(
          "kernel",
          [](const R& r) {
            Samples out({static_cast<py::ssize_t>(r.kernel.size()), py::ssize_t{6}, py::ssize_t{6}});
            double* at = out.mutable_data();
            for (const Mat6d& sample : r.kernel) {
              Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>{at} = sample;
              at += 36;
            }
            return out;
          },
          "(n, 6, 6), N and N m per m/s and rad/s and s, copy");
}

void bind_vessel(py::module_& m) {
  using B = StateSpaceBlock;
  py::class_<B>(m, "StateSpaceBlock",
                "Fluid memory x' = A x + B u, mu = C x + D u between motions 0 (surge) ... 5 (yaw), of a "
                "group six for each vessel in turn, eqs (29)-(30).")
      .def(py::init([](std::vector<int> inputs, std::vector<int> outputs, MatXd a, MatXd b, MatXd c, MatXd d,
                       VecXd state_scale) {
             return B{std::move(inputs), std::move(outputs), std::move(a),          std::move(b),
                      std::move(c),      std::move(d),       std::move(state_scale)};
           }),
           py::kw_only(), py::arg("inputs"), py::arg("outputs"), py::arg("a"), py::arg("b"), py::arg("c"),
           py::arg("d"), py::arg("state_scale") = VecXd())
      .def_readonly("inputs", &B::inputs)
      .def_readonly("outputs", &B::outputs)
      .def_property_readonly("a", copied(&B::a))
      .def_property_readonly("b", copied(&B::b))
      .def_property_readonly("c", copied(&B::c))
      .def_property_readonly("d", copied(&B::d))
      .def_property_readonly("state_scale", copied(&B::state_scale));
  bind_retardation(m);
  description::bind<VesselDescription>(m, "vessel");
  description::bind<HydroGroupDescription>(m, "group");
}

}  // namespace

void add_load(LoadDescriptions& loads, const py::object& object) {
  for (const LoadBinding* kind : load_bindings()) {
    if (kind->add(loads, object)) return;
  }
  throw std::invalid_argument("load " + py::repr(object).cast<std::string>() + " is of no known kind");
}

void bind_elements(py::module_& m) {
  bind_fields(m);
  description::bind<BodyDescription>(m, "body");
  bind_joint(m);
  bind_joint_kinds(m);
  description::bind<DriverDescription>(m, "driver");
  description::bind<PointDescription>(m, "point");
  bind_loads(m);
  bind_vessel(m);
}
