//! Small systems with closed-form event times and derivatives, by the explicit and by the implicit method.
//!
//! Each row names a system, a start and parameters; its closed form gives the transitions in order, their times, the end, and, by
//! dual numbers, the derivatives of the end and of the duration with respect to the start (products of flows and
//! saltation matrices) and to all parameters. `products` has the saltation matrices as literals.
//!
//! | covered | where |
//! |---|---|
//! | falling, rising, either; the direction that does not count | `directions` |
//! | several crossings in one step | `directions` (cubic), `curved` (lens) |
//! | identity reset: the saltation matrix is the identity | `directions` (harmonic), `products` |
//! | a guard zero at the start: leaves up or down, returns, zero slope, zero curvature, stays zero | `starts` |
//! | a reset that lands on another guard, at rest or moving either way | `starts` (landing) |
//! | time events in tau and in t; resets and flows that use tau and t | `clocks`, `directions` (spiral) |
//! | ties of two and three, ties with the section, near ties in both orders | `ties` |
//! | `when` true, false, on its edge, switching just before or after the crossing, passing over crossings in one step | `whens` |
//! | grazing in a sequence, touch, near miss, inflection | `grazing` |
//! | mode changes, several transitions in a map, memory, parameters in resets | `resets` |
//! | guards: circle (from inside, from outside, twice in a step), product, exponential; a nonlinear flow | `curved` |
//! | moving surfaces | `flights` (floor), `piling` (wall) |
//! | jumps of the flow, several at once, one under another's selector, kinks, switch together with guard, switches in tau and t | `switches` |
//! | sliding, chattering, a relay with hysteresis, Zeno (ball, closing walls) | `piling` |
//! | very long and very short flights | `flights` |
//! | stiff flows, the end of the domain, blow-up, the time limit before, at and after an event | `limits` |
//! | plans, replays in one number and in lanes, second derivatives, for every row that has a plan | `replays` |
//! | a section before its transition | `before`, with the falling ball of the other tests |

#![allow(unreachable_pub)] // modules of a test
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)] // a failed expectation is a failed test

#[path = "../common/mod.rs"]
mod common;

mod before;
mod check;
mod clocks;
mod curved;
mod directions;
mod family;
mod flights;
mod grazing;
mod limits;
mod piling;
mod products;
mod replays;
mod resets;
mod starts;
mod sweeps;
mod switches;
mod ties;
mod whens;
