"""The symbolic step of gaitc: expression graphs in, CasADi instruction tapes out.

Reads one JSON request from stdin and prints one JSON answer. Optional argument: a folder to import CasADi from. The
request holds op codes, indices and numbers only; nothing in it is ever evaluated as text. All the rest of the compiler
is in Rust; see `exchange.rs` for both formats.
"""

import sys

# `python -c` puts the current folder first: no file that lies about may stand in for a library.
sys.path[:] = [folder for folder in sys.path if folder not in ("", ".")]
if len(sys.argv) > 1:
    sys.path.insert(0, sys.argv[1])

import json

try:
    import casadi
except ImportError as error:
    sys.exit(f"this Python ({sys.executable}) cannot import casadi: {error}")

UNARY = {
    name: getattr(casadi, name)
    for name in (
        "sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp log sqrt"
    ).split()
}
BINARY = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "atan2": casadi.atan2,
}
OP_NAMES = {
    getattr(casadi, name): name[3:].lower() for name in dir(casadi) if name.startswith("OP_")
}
# Larger whole exponents gain nothing from multiplications.
LARGEST_PRODUCT = 64


def power(base, exponent):
    """A power; small whole constant exponents become products, 1/2 the square root."""
    if exponent.is_constant():
        value = float(exponent)
        whole = value == int(value) if abs(value) <= LARGEST_PRODUCT else False
        if whole or value == 0.5:
            return base**value
        if value == -0.5:
            return 1 / casadi.sqrt(base)
    return base**exponent


def choose(condition, then, otherwise):
    """One of two values. Never a sum of products: a NaN that is not chosen has to stay out."""
    return casadi.if_else(condition, then, otherwise)


def partial(expression, symbol):
    """Partial derivative of a scalar by one input.

    Forward mode: the derivative of a choice is the choice of the derivatives, so that a NaN of the branch not taken is
    dropped after it arose and not multiplied by zero before.
    """
    return casadi.densify(casadi.jtimes(expression, symbol, casadi.SX(1)))


def node_value(node, inputs, values):
    """The SX expression of one node; operands are in `values` already."""
    op = node["op"]
    args = [values[i] for i in node.get("args", ())]
    if op == "constant":
        return casadi.SX(node["value"])
    if op == "input":
        return inputs[node["input"]]
    if op == "neg":
        return -args[0]
    if op == "pow":
        return power(*args)
    if op == "select":
        return choose(inputs[node["input"]], *args)
    if op == "choose":
        return choose(args[0] >= 0, *args[1:])
    if op == "partial":
        return partial(args[0], inputs[node["input"]])
    if op in UNARY:
        return UNARY[op](*args)
    return BINARY[op](*args)


def tape(function):
    """The instructions of a CasADi function, registers as they are."""
    instructions = []
    for k in range(function.n_instructions()):
        op = function.instruction_id(k)
        constant = op == casadi.OP_CONST
        instructions.append(
            {
                "op": OP_NAMES[op],
                "out": list(function.instruction_output(k)),
                "args": [] if constant else list(function.instruction_input(k)),
                "value": repr(float(function.instruction_constant(k))) if constant else None,
            }
        )
    return instructions


def derive_function(request, vector, inputs, rates, values):
    """Value and Jacobian of one function as one tape."""
    value = casadi.densify(casadi.vertcat(casadi.SX(0, 1), *[values[i] for i in request["values"]]))
    if request["rates"] is not None:
        flow = casadi.vertcat(*[values[i] for i in request["rates"]])
        value = casadi.substitute(value, rates, flow)
    by = casadi.vertcat(casadi.SX(0, 1), *[inputs[i] for i in request["by"]])
    # Forward mode only, for the reason given at `partial`.
    jacobian = casadi.sparsify(casadi.jacobian(value, by, {"allow_reverse": False}))
    value, jacobian = casadi.cse([value, jacobian])
    rows, columns = jacobian.sparsity().get_triplet()
    function = casadi.Function("derived", [vector], [value, jacobian])
    return {
        "instructions": tape(function),
        "rows": value.numel(),
        "nonzeros": list(zip(rows, columns)),
    }


def derive_model(request):
    """All functions of one model."""
    vector = casadi.SX.sym("input", request["inputs"])
    inputs = [vector[i] for i in range(request["inputs"])]
    rates = casadi.vertcat(casadi.SX(0, 1), *[inputs[i] for i in request["rates"]])
    values = []
    for node in request["nodes"]:
        values.append(node_value(node, inputs, values))
    return [
        derive_function(function, vector, inputs, rates, values) for function in request["functions"]
    ]


def main():
    request = json.load(sys.stdin)
    if casadi.__version__ != request["casadi"]:
        sys.exit(
            f"this Python ({sys.executable}) has casadi {casadi.__version__}, "
            f"but casadi {request['casadi']} is needed"
        )
    json.dump({"models": [derive_model(model) for model in request["models"]]}, sys.stdout)


main()
