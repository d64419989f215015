package io.troupe.petri.wiring;

import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;

/**
 * A random wiring of all kinds of steps: plans what each component offers, then draws the states that offer and use it.
 */
final class RandomWiring {
    private final Random random;
    private List<Plan> plans = List.of();

    /** What the others may know about a component. */
    private record Plan(
            String name,
            boolean calls,
            boolean accepts,
            boolean refuses,
            boolean streams,
            int messages,
            boolean rejects,
            boolean fails,
            boolean finishes,
            Overflow overflow) {
        boolean mayReject(String call) {
            return fails || call.equals("call") && (rejects || refuses);
        }
    }

    RandomWiring(Random random) {
        this.random = random;
    }

    Wiring wiring(String name) {
        while (true) {
            try {
                return attempt(name);
            } catch (IllegalArgumentException e) {
                // does not fit together: the next attempt has other random numbers
            }
        }
    }

    private Wiring attempt(String name) {
        var count = random.nextInt(3) == 0 ? 3 : 2;
        var planned = new ArrayList<Plan>();
        for (var i = 0; i < count; i++) {
            var calls = random.nextInt(3) > 0;
            var accepts = calls && random.nextBoolean();
            planned.add(new Plan(
                    "c" + i,
                    calls,
                    accepts,
                    accepts && random.nextInt(3) == 0,
                    random.nextInt(4) == 0,
                    random.nextInt(3) == 0 ? 2 : random.nextInt(2),
                    random.nextInt(4) == 0,
                    random.nextInt(8) == 0,
                    random.nextInt(4) > 0,
                    Overflow.values()[random.nextInt(3)]));
        }
        plans = planned;
        var wiring = Wiring.of(name);
        var offered = new HashSet<String>();
        var used = new HashSet<String>();
        for (var plan : plans) {
            var protocol = protocol(plan);
            wiring.component(protocol);
            protocol.provided().forEach(call -> offered.add(plan.name + "." + call));
            protocol.received().forEach(message -> offered.add(plan.name + "." + message));
            used.addAll(protocol.requested());
            used.addAll(protocol.sent());
            if (plan.messages > 0) {
                wiring.mailbox(plan.name, random.nextInt(3) == 0 ? 2 : 1, plan.overflow);
            }
            if (plan.streams && random.nextBoolean()) {
                wiring.window(plan.name + ".flow", 2);
            }
        }
        offered.removeAll(used);
        offered.stream().sorted().forEach(wiring::open);
        return together(
                wiring.resource("r0", 1).resource("r1", 1 + random.nextInt(2)).build());
    }

    /** Some wirings stop in one step, or in one for each of two groups. */
    private Wiring together(Wiring wiring) {
        var stopping = wiring.components().stream()
                .filter(component -> !wiring.protocol(component).stopStates().isEmpty())
                .toList();
        if (stopping.isEmpty() || random.nextInt(3) > 0) {
            return wiring;
        }
        return random.nextBoolean()
                ? wiring.withSynchronisedStop()
                : wiring.withSynchronisedStops(
                        stopping.stream().map(component -> Set.of(component)).toList());
    }

    private Protocol protocol(Plan me) {
        var states = 2 + random.nextInt(2);
        var held = new ArrayList<>(List.of(""));
        var out = new ArrayList<Map<String, Branch>>();
        for (var i = 0; i < states; i++) {
            held.add(random.nextInt(4) == 0 ? "r" + random.nextInt(2) : "");
            out.add(new LinkedHashMap<>());
        }
        for (var state = 0; state < states; state++) {
            var ways = 1 + random.nextInt(2);
            for (var i = 0; i < ways; i++) {
                draw(me, out.get(state), state, i == 0 ? (state + 1) % states : random.nextInt(states), held);
            }
            if (state > 0 && held.get(state).isEmpty() && random.nextInt(5) == 0) {
                add(out.get(state), Protocol.stops());
            }
        }
        if (random.nextInt(4) == 0) {
            var last = emptyHanded(states, held);
            add(out.get(last), Protocol.does("leave").then("over"));
        }
        if (me.accepts) {
            accepts(me, states, held, out);
        }
        required(me, out).forEach(kind -> {
            var state = random.nextInt(states);
            add(out.get(state), kind.then("s" + state));
        });
        var builder = Protocol.of(me.name);
        var names = List.of("owing", "done", "two");
        for (var state = 0; state < out.size(); state++) {
            var name = state < states ? "s" + state : names.get(state - states);
            builder.state(name, out.get(state).values().toArray(new Branch[0]));
        }
        if (out.stream().anyMatch(branches -> branches.containsKey("does leave"))) {
            builder.state("over", Protocol.ends());
        }
        if (me.fails) {
            builder.failsTo("s" + emptyHanded(states, held));
        }
        return builder.build();
    }

    /** Some way out of a state accepts the call, and a new state or two answer it after other steps. */
    private void accepts(Plan me, int states, List<String> held, List<Map<String, Branch>> out) {
        var from = random.nextInt(states);
        var back = random.nextInt(states);
        for (var i = 0; !held.get(from).equals(held.get(back)); i++) {
            back = i;
        }
        add(out.get(from), Protocol.accepts("call").then("owing"));
        var owing = new LinkedHashMap<String, Branch>();
        var ways = 1 + random.nextInt(2);
        for (var i = 0; i < ways; i++) {
            var kinds = kinds(me);
            var kind = kinds.get(random.nextInt(kinds.size()));
            add(owing, perhapsRejected(me, kind.then(random.nextInt(3) == 0 ? "owing" : "done"), "done"));
        }
        add(owing, Protocol.does("y").then("done"));
        out.add(owing);
        var done = new LinkedHashMap<String, Branch>();
        add(done, Protocol.answers("call").then("s" + back));
        if (me.refuses) {
            add(done, Protocol.refuses("call").then("s" + back));
        }
        if (random.nextInt(3) == 0) {
            add(done, Protocol.accepts("call").then("two"));
            var two = new LinkedHashMap<String, Branch>();
            add(two, Protocol.answers("call").then("done"));
            out.add(done);
            out.add(two);
        } else {
            out.add(done);
        }
    }

    private int emptyHanded(int states, List<String> held) {
        var state = random.nextInt(states);
        return held.get(state).isEmpty() ? state : 0;
    }

    private void draw(Plan me, Map<String, Branch> out, int state, int to, List<String> held) {
        var here = held.get(state);
        var there = held.get(to);
        var target = "s" + to;
        if (here.equals(there)) {
            var kinds = kinds(me);
            var kind = kinds.get(random.nextInt(kinds.size()));
            add(out, perhapsRejected(me, kind.then(target), "s" + state));
        } else if (here.isEmpty()) {
            add(out, perhaps(Protocol.acquires(there)).then(target));
        } else if (there.isEmpty()) {
            add(out, Protocol.releases(here).then(target));
        }
    }

    /** The step, with its time-out and its rejection where it has to have one. */
    private Branch perhapsRejected(Plan me, Branch step, String state) {
        var branch = step;
        var word = branch.toString();
        var other = word.startsWith("requests c") || word.startsWith("sends c")
                ? plans.get(word.charAt(word.indexOf(" c") + 2) - '0')
                : me;
        if (word.startsWith("requests") && random.nextInt(3) == 0) {
            branch = branch.orTimeout(state);
        }
        if (word.startsWith("requests") && other.mayReject("call")
                || word.startsWith("sends") && other.overflow == Overflow.REJECT && random.nextBoolean()) {
            branch = branch.orRejected(state);
        }
        return branch;
    }

    private Branch.Builder perhaps(Branch.Builder step) {
        return random.nextInt(4) == 0 ? Protocol.tries(step) : step;
    }

    /** The steps that a component may take. */
    private List<Branch.Builder> kinds(Plan me) {
        var kinds = new ArrayList<Branch.Builder>();
        for (var other : plans) {
            if (other == me) {
                continue;
            }
            if (other.calls) {
                kinds.add(Protocol.requests(other.name + ".call"));
                kinds.add(perhaps(Protocol.asks(other.name + ".call")));
            }
            if (other.streams) {
                kinds.add(perhaps(Protocol.asks(other.name + ".flow")));
            }
            for (var message = 0; message < other.messages; message++) {
                kinds.add(perhaps(Protocol.sends(other.name + ".m" + message)));
            }
        }
        kinds.addAll(own(me));
        if (kinds.isEmpty() || random.nextInt(4) == 0) {
            kinds.add(Protocol.does("x"));
        }
        return kinds;
    }

    private List<Branch.Builder> own(Plan me) {
        var own = new ArrayList<Branch.Builder>();
        if (me.calls) {
            if (!me.refuses) {
                own.add(Protocol.provides("call"));
            }
            if (me.rejects) {
                own.add(Protocol.rejects("call"));
            }
        }
        if (me.streams) {
            own.add(Protocol.streams("flow"));
            own.add(perhaps(Protocol.emits("flow")));
            if (me.finishes) {
                own.add(Protocol.finishes("flow"));
            }
        }
        for (var message = 0; message < me.messages; message++) {
            own.add(Protocol.receives("m" + message));
        }
        return own;
    }

    /** What has to be in some state: what the others expect of the component, and what comes back to it. */
    private List<Branch.Builder> required(Plan me, List<Map<String, Branch>> out) {
        var required = new ArrayList<>(own(me));
        for (var other : plans) {
            for (var call : List.of("call", "flow")) {
                var target = other.name + "." + call;
                if (out.stream().noneMatch(branches -> branches.containsKey("asks " + target))) {
                    continue;
                }
                required.add(Protocol.answered(target));
                if (other.mayReject(call)) {
                    required.add(Protocol.rejected(target));
                }
                if (call.equals("flow") && other.finishes) {
                    required.add(Protocol.finished(target));
                }
                if (random.nextBoolean()) {
                    required.add(Protocol.cancels(target));
                }
            }
        }
        return required;
    }

    private static void add(Map<String, Branch> out, Branch branch) {
        out.putIfAbsent(branch.toString(), branch);
    }
}
