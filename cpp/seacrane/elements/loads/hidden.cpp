#include "seacrane/elements/loads/hidden.hpp"

#include <utility>

#include "seacrane/elements/loads/registry.hpp"

namespace seacrane {

template <class T>
Hidden<T>::Hidden() : value_(std::make_unique<T>()) {}
template <class T>
Hidden<T>::Hidden(const Hidden& other) : value_(std::make_unique<T>(*other.value_)) {}
template <class T>
Hidden<T>::Hidden(Hidden&& other) noexcept = default;
template <class T>
Hidden<T>& Hidden<T>::operator=(Hidden other) noexcept {
  std::swap(value_, other.value_);
  return *this;
}
template <class T>
Hidden<T>::~Hidden() = default;

template class Hidden<LoadDescriptions>;
template class Hidden<CompiledLoads>;

}  // namespace seacrane
