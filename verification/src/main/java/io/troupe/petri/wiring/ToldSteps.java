package io.troupe.petri.wiring;

import io.troupe.petri.Transition;
import io.troupe.petri.wiring.ProtocolEvent.Kind;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Optional;
import java.util.OptionalInt;
import java.util.Set;

/**
 * The steps of a trace for a reader. A call is one step if its caller and its provider do nothing else from the request
 * to the answer, and so is what a component has decided and does next.
 *
 * <p>The one step stands where the last of its firings is. The firings of others in between take no tokens of these two
 * components, so they may come first: the steps are a firing sequence to the same marking.
 */
final class ToldSteps {
    private final List<WiringNet.Event> events;
    private final List<String> names;
    private final boolean[] isLeftOut;

    ToldSteps(List<Transition> trace, WiringNet net) {
        events = trace.stream().map(net::event).toList();
        names = new ArrayList<>(trace.stream().map(net::name).toList());
        isLeftOut = new boolean[trace.size()];
    }

    List<String> steps() {
        for (var i = 0; i < names.size(); i++) {
            if (is(i, Kind.WAITS)) {
                leaveOutDecision(i);
            } else if (is(i, Kind.ASKED)) {
                leaveOutCall(i);
            }
        }
        var told = new ArrayList<String>();
        for (var i = 0; i < names.size(); i++) {
            if (!isLeftOut[i]) {
                told.add(names.get(i));
            }
        }
        return told;
    }

    private boolean is(int at, Kind kind) {
        return events.get(at).seen().filter(each -> each.kind() == kind).isPresent();
    }

    /** A component has decided on a step that may have to wait, and takes it next. */
    private void leaveOutDecision(int at) {
        var who = events.get(at).who();
        isLeftOut[at] = next(at, who).stream()
                .anyMatch(next -> is(next, Kind.ACQUIRED)
                        || is(next, Kind.SENT)
                        || is(next, Kind.EMITTED)
                        || is(next, Kind.ASKED));
    }

    private void leaveOutCall(int asked) {
        var call = events.get(asked).seen().orElseThrow();
        var both = Set.of(call.component(), call.provider());
        var parts = new ArrayList<>(List.of(asked));
        for (var kind : List.of(Kind.TAKEN, Kind.ANSWERED)) {
            var next = next(parts.getLast(), both);
            if (kind == Kind.ANSWERED && next.isPresent() && isServing(next.getAsInt(), call)) {
                parts.add(next.getAsInt());
                next = next(parts.getLast(), both);
            }
            if (!isOf(next, kind, call)) {
                return;
            }
            parts.add(next.getAsInt());
        }
        var taken = next(parts.getLast(), both);
        if (isOf(taken, Kind.GOT_ANSWER, call)) {
            parts.add(taken.getAsInt());
        } else if (names.get(asked).contains(" and goes on")) {
            return;
        }
        parts.forEach(part -> isLeftOut[part] = true);
        isLeftOut[parts.getLast()] = false;
        names.set(
                parts.getLast(),
                names.get(asked).replaceFirst(" asks ", " calls ").replace(" and goes on", "") + ", which answers");
    }

    /** The provider executes the call. */
    private boolean isServing(int at, ProtocolEvent call) {
        return events.get(at).who().equals(Set.of(call.provider()))
                && events.get(at).seen().isEmpty()
                && names.get(at).startsWith(call.provider() + " does ");
    }

    private boolean isOf(OptionalInt at, Kind kind, ProtocolEvent call) {
        return at.isPresent()
                && events.get(at.getAsInt())
                        .seen()
                        .equals(Optional.of(new ProtocolEvent(kind, call.component(), call.what())));
    }

    /** The next firing in which one of these components takes part. */
    private OptionalInt next(int after, Set<String> components) {
        for (var i = after + 1; i < events.size(); i++) {
            if (!Collections.disjoint(events.get(i).who(), components)) {
                return OptionalInt.of(i);
            }
        }
        return OptionalInt.empty();
    }

    /** The steps one per line, under a heading. */
    static String lines(List<String> steps, String remark) {
        var text = new StringBuilder("\n  after ")
                .append(steps.size())
                .append(steps.size() == 1 ? " step" : " steps")
                .append(remark)
                .append(':');
        for (var i = 0; i < steps.size(); i++) {
            text.append("\n    ").append(i + 1).append(". ").append(steps.get(i));
        }
        return text.toString();
    }
}
