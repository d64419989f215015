package io.troupe.petri.wiring;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;
import static io.troupe.petri.wiring.Protocol.stops;
import static java.util.stream.Collectors.toMap;
import static java.util.stream.Collectors.toSet;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.Liveness;
import io.troupe.petri.ProgressSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchEnd;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.WiringResult.Blocked;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.Proved;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import java.util.function.Function;
import org.junit.jupiter.api.Test;

/** Random wirings, checked through the net and by executing the declarations directly. */
class RandomWiringTest {
    private static final int WIRINGS = 200;

    /** The status of a component: in a state, waiting for an answer, being served, or serving a call. */
    private record Status(String phase, String at, String target, String to) {
        static Status in(String state) {
            return new Status("in", state, "", "");
        }
    }

    private record Move(Set<String> who, Map<String, Status> next) {
        static Move of(Map<String, Status> now, Map<String, Status> changed) {
            var next = new HashMap<>(now);
            next.putAll(changed);
            return new Move(changed.keySet(), next);
        }
    }

    private static Wiring random(long seed) {
        var random = new Random(seed);
        var count = 2 + random.nextInt(2);
        var offers = new ArrayList<Integer>();
        var open = new HashSet<String>();
        for (var i = 0; i < count; i++) {
            offers.add(random.nextInt(3));
            for (var call = 0; call < offers.get(i); call++) {
                open.add("c" + i + ".call" + call);
            }
        }
        var wiring = Wiring.of("seed " + seed);
        for (var i = 0; i < count; i++) {
            var protocol = protocol(i, offers, random);
            protocol.requested().forEach(open::remove);
            wiring.component(protocol);
        }
        open.forEach(wiring::open);
        return wiring.build();
    }

    private static Protocol protocol(int self, List<Integer> offers, Random random) {
        var states = 2 + random.nextInt(3);
        var branches = new ArrayList<Map<String, Branch>>();
        var offered = new ArrayList<Integer>();
        for (var call = 0; call < offers.get(self); call++) {
            offered.add(random.nextInt(states));
        }
        for (var state = 0; state < states; state++) {
            var out = new LinkedHashMap<String, Branch>();
            for (var call = 0; call < offered.size(); call++) {
                if (offered.get(call) == state) {
                    add(out, provides("call" + call).then("s" + target(out, state, states, random)));
                }
            }
            while (out.isEmpty() || random.nextInt(3) == 0) {
                var to = "s" + target(out, state, states, random);
                var other = random.nextInt(offers.size());
                if (other != self && offers.get(other) > 0 && random.nextInt(3) > 0) {
                    var call = "c" + other + ".call" + random.nextInt(offers.get(other));
                    add(out, requests(call).then(to));
                } else {
                    add(out, does("step " + out.size() + random.nextInt(2)).then(to));
                }
            }
            if (state > 0 && random.nextInt(4) == 0) {
                add(out, stops());
            }
            branches.add(out);
        }
        var builder = Protocol.of("c" + self);
        for (var state = 0; state < states; state++) {
            builder.state("s" + state, branches.get(state).values().toArray(new Branch[0]));
        }
        return builder.build();
    }

    private static void add(Map<String, Branch> out, Branch branch) {
        out.putIfAbsent(branch.toString(), branch);
    }

    /** The first branch of each state leads to the next one, so that all are reachable. */
    private static int target(Map<String, Branch> out, int state, int states, Random random) {
        return out.isEmpty() ? (state + 1) % states : random.nextInt(states);
    }

    private static List<Move> moves(Wiring wiring, Map<String, Status> now) {
        var moves = new ArrayList<Move>();
        now.forEach((component, status) -> {
            switch (status.phase()) {
                case "in" ->
                    wiring.protocol(component).out(status.at()).forEach(step -> {
                        if (step instanceof Step.Provides offer) {
                            accept(wiring, moves, now, component, offer);
                        } else {
                            moves.add(Move.of(now, Map.of(component, after(step, status))));
                        }
                    });
                case "asked" -> {
                    var done = new Status("done", "", status.target(), status.to());
                    moves.add(Move.of(now, Map.of(component, done)));
                }
                case "done" ->
                    now.forEach((caller, asking) -> {
                        if (asking.phase().equals("served") && asking.target().equals(status.target())) {
                            var answered = Map.of(component, Status.in(status.to()), caller, Status.in(asking.to()));
                            moves.add(Move.of(now, answered));
                        }
                    });
                default -> {}
            }
        });
        return moves;
    }

    private static Status after(Step step, Status before) {
        return step instanceof Step.Requests asks
                ? new Status("asks", before.at(), asks.role() + "." + asks.call(), asks.to())
                : Status.in(step.to());
    }

    private static void accept(
            Wiring wiring, List<Move> moves, Map<String, Status> now, String component, Step.Provides offer) {
        var target = component + "." + offer.call();
        if (wiring.components().stream()
                .noneMatch(c -> wiring.protocol(c).requested().contains(target))) {
            moves.add(Move.of(now, Map.of(component, Status.in(offer.to()))));
        }
        now.forEach((caller, asking) -> {
            if (asking.phase().equals("asks") && asking.target().equals(target)) {
                var asked = new Status("asked", "", target, offer.to());
                var served = new Status("served", asking.at(), target, asking.to());
                moves.add(Move.of(now, Map.of(component, asked, caller, served)));
            }
        });
    }

    /** All statuses that can be reached from one of them, with the moves out of each. */
    private static Map<Map<String, Status>, List<Move>> reached(
            Map<String, Status> start, Function<Map<String, Status>, List<Move>> movesFrom) {
        var reached = new LinkedHashMap<Map<String, Status>, List<Move>>();
        var ahead = new ArrayDeque<>(List.of(start));
        while (!ahead.isEmpty()) {
            var now = ahead.remove();
            if (!reached.containsKey(now)) {
                var moves = movesFrom.apply(now);
                reached.put(now, moves);
                moves.forEach(move -> ahead.add(move.next()));
            }
        }
        return reached;
    }

    private static boolean someoneIsBlocked(Wiring wiring, Map<Map<String, Status>, List<Move>> all) {
        return all.keySet().stream().anyMatch(from -> {
            var movers = new HashSet<String>();
            reached(from, all::get).values().forEach(moves -> moves.forEach(move -> movers.addAll(move.who())));
            return movers.size() < wiring.components().size();
        });
    }

    @Test
    void check_ofRandomWirings_isAsPlayingTheDeclarationsSays() {
        var kinds = new HashMap<Class<?>, Integer>();
        for (var seed = 0L; seed < WIRINGS; seed++) {
            var wiring = random(seed);
            var start = wiring.components().stream().collect(toMap(c -> c, c -> Status.in("s0")));
            var reached = reached(start, now -> moves(wiring, now));
            var dead = (int) reached.values().stream().filter(List::isEmpty).count();

            var result = WiringCheck.check(wiring);

            assertThat(List.of(result.figures().markings(), result.figures().deadMarkings()))
                    .as("markings and dead markings of seed %d", seed)
                    .containsExactly(reached.size(), dead);
            if (reached.size() <= 100 && dead == 0) {
                var expected = someoneIsBlocked(wiring, reached) ? Blocked.class : Proved.class;
                assertThat(result).as("result of seed %d", seed).isInstanceOf(expected);
            }
            if (result instanceof Deadlock deadlock) {
                var components = wiring.components().size();
                deadlock.counterexamples().forEach(each -> requireCircle(each, components));
            }
            kinds.merge(result.getClass(), 1, Integer::sum);
        }
        assertThat(kinds).containsOnlyKeys(Proved.class, Blocked.class, Deadlock.class);
        assertThat(kinds.values()).as("%s", kinds).allMatch(number -> number > 10);
    }

    /**
     * The searches by stubborn sets and the full graph agree: on all dead markings, and on the components that can be
     * blocked.
     */
    @Test
    void reducedSearches_ofRandomWirings_agreeWithTheFullGraph() {
        var withDead = 0;
        var withBlocks = 0;
        for (var seed = 0L; seed < 3 * WIRINGS; seed++) {
            var wiring = random(seed);
            var net = new WiringNet(wiring, new LinkedHashSet<>(wiring.components()));
            var graph = ReachabilityGraph.explore(net.net());
            var limits = SearchLimits.markings(graph.size());

            var reduced = DeadlockSearch.run(net.net(), limits);
            var progress = ProgressSearch.run(net.net(), limits);

            assertThat(reduced.deadlocks())
                    .as("dead markings of seed %d", seed)
                    .extracting(DeadlockSearch.Deadlock::marking)
                    .containsExactlyInAnyOrderElementsOf(graph.dead().stream()
                            .map(ReachabilityGraph.State::marking)
                            .toList());
            assertThat(progress.end()).as("seed %d", seed).isEqualTo(SearchEnd.COMPLETE);
            var search = new WiringSearch(wiring, net, graph);
            assertThat(search.blocks(progress.losses()).isEmpty())
                    .as("no blocks in seed %d", seed)
                    .isEqualTo(search.blocks().isEmpty());
            assertThat(search.blocks(progress.losses()))
                    .as("who is blocked in seed %d", seed)
                    .extracting(
                            each -> each.waits().stream().map(Wait::component).collect(toSet()))
                    .containsExactlyInAnyOrderElementsOf(stuckInTheEnd(net, graph));
            withDead += graph.dead().isEmpty() ? 0 : 1;
            withBlocks += graph.dead().isEmpty() && !search.blocks().isEmpty() ? 1 : 0;
        }
        assertThat(withDead).isGreaterThan(30);
        assertThat(withBlocks).isGreaterThan(30);
    }

    /** For each terminal component of the full graph: the components that never take a step in it, if there are any. */
    private static Set<Set<String>> stuckInTheEnd(WiringNet net, ReachabilityGraph graph) {
        var all = new HashSet<Set<String>>();
        for (var end : Liveness.of(graph).terminalComponents()) {
            var stuck = new HashSet<>(net.chosen());
            net.net().transitions().stream()
                    .filter(end::fires)
                    .forEach(transition -> stuck.removeAll(net.event(transition).who()));
            if (!stuck.isEmpty()) {
                all.add(stuck);
            }
        }
        return all;
    }

    /** In a deadlock all components wait, and each one in the circle waits for the next. */
    private static void requireCircle(Counterexample counterexample, int components) {
        assertThat(counterexample.waits()).hasSize(components);
        var circle = counterexample.circle();
        assertThat(circle).isNotEmpty();
        for (var i = 0; i < circle.size(); i++) {
            assertThat(circle.get(i).on())
                    .contains(circle.get((i + 1) % circle.size()).component());
        }
    }
}
