# SPDX-License-Identifier: MIT
"""The few names of PyTorch that docs/python.md shows, over NumPy: for its test where PyTorch is not installed."""
import types

import numpy as np

float64 = np.float64


class Tensor:
    def __init__(self, values, requires_grad=False, backward=None):
        self.values, self.requires_grad, self._backward, self.grad = values, requires_grad, backward, None

    def __len__(self):
        return len(self.values)

    def __getitem__(self, key):
        return Tensor(self.values[key])

    def __mul__(self, other):
        return Tensor(self.values * other.values)

    def detach(self):
        return Tensor(self.values)

    def numpy(self):
        return self.values

    def sum(self):
        return Tensor(self.values.sum(), backward=lambda grad: self._backward(Tensor(grad.values * np.ones_like(self.values))))

    def backward(self):
        self._backward(Tensor(np.float64(1)))


def tensor(values, dtype, requires_grad=False):
    return Tensor(np.array(values, dtype), requires_grad)


def from_numpy(values):
    return Tensor(values)


class _Context:
    def save_for_backward(self, *tensors):
        self.saved_tensors = tensors


class _Function:
    @classmethod
    def apply(cls, *arguments):
        context = _Context()

        def backward(grad):
            grads = cls.backward(context, grad)
            for argument, one in zip(arguments, grads, strict=True):
                if isinstance(argument, Tensor) and argument.requires_grad:
                    argument.grad = one

        answer = cls.forward(context, *arguments)
        return Tensor(answer.values, backward=backward)


autograd = types.SimpleNamespace(Function=_Function)
