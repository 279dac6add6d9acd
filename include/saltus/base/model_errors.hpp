// The kinds of model errors that a program may want to tell apart.
#pragma once

#include "saltus/base/error.hpp"

namespace saltus {

/// A call of DiagramBuilder is wrong.
class BuilderError : public ModelError {
 public:
  using ModelError::ModelError;
};

/// Two blocks of a diagram have one name.
class SystemNameNotUniqueError : public BuilderError {
 public:
  using BuilderError::BuilderError;
};

/// A diagram without a block was built.
class EmptyDiagramError : public BuilderError {
 public:
  using BuilderError::BuilderError;
};

/// A block, or the way the blocks are connected, is wrong.
class StaticError : public ModelError {
 public:
  using ModelError::ModelError;
};

/// A value or a word that a block was made with is impossible.
class BlockParameterError : public StaticError {
 public:
  using StaticError::StaticError;
};

/// An input has no source.
class InputNotConnectedError : public StaticError {
 public:
  using StaticError::StaticError;
};

/// Outputs depend on one another at the same time.
class AlgebraicLoopError : public StaticError {
 public:
  using StaticError::StaticError;
};

/// An input expects another number of values than its source has.
class ShapeMismatchError : public StaticError {
 public:
  using StaticError::StaticError;
};

}  // namespace saltus
