package io.troupe.petri.wiring;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Answer.No;
import io.troupe.petri.Answer.Yes;
import io.troupe.petri.DeadlockSearch;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.Simulation.World;
import io.troupe.petri.wiring.WiringProgress.Fails;
import io.troupe.petri.wiring.WiringResult.Blocked;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.Proved;
import io.troupe.tools.Thorough;
import java.util.EnumMap;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;

/**
 * Random wirings of all kinds of steps are as a {@link Simulation} of their declarations, which knows no net: the
 * states and steps of the net, the verdict, and what a monitor allows, event by event.
 *
 * <p>{@code -Dwirings=10000} compares that many, and prints how many there were of each kind.
 */
class RandomDeclarationsTest {
    private static final int WIRINGS = Integer.getInteger("wirings", Thorough.times(30, 200));
    private static final int MAX_WORLDS = 1_500;
    private static final int EVENTS = 40;

    private final Map<String, Integer> kinds = new HashMap<>(); // of steps in the compared wirings
    private final Map<Class<?>, Integer> verdicts = new HashMap<>();
    private final Map<ProtocolEvent.Kind, Integer> events = new EnumMap<>(ProtocolEvent.Kind.class);
    private int compared;
    private int refused;
    private int idle;
    private int notIdle;
    private int reached; // of 5 combinations of states for each wiring

    @Test
    void randomWirings_areAsTheSimulationOfTheirDeclarations() {
        var seed = 0L;
        for (; compared < WIRINGS; seed++) {
            var random = new Random(seed);
            var wiring = new RandomWiring(random).wiring("seed " + seed);
            var simulation = new Simulation(wiring, MAX_WORLDS);
            if (!simulation.isComplete()) {
                continue; // too many
            }
            compared++;
            if (!simulation.someEnd()) {
                compareNet(wiring, simulation);
            }
            compareQuestions(wiring, simulation, random);
            compareVerdict(wiring, simulation);
            compareMonitor(wiring, simulation, random);
            for (var component : wiring.components()) {
                wiring.protocol(component)
                        .steps()
                        .forEach(step -> kinds.merge(step.getClass().getSimpleName(), 1, Integer::sum));
                wiring.protocol(component).failure().ifPresent(state -> kinds.merge("failsTo", 1, Integer::sum));
            }
            kinds.merge(wiring.stopsTogether() ? "stops together" : "stops alone", 1, Integer::sum);
        }
        if (System.getProperty("wirings") != null) {
            System.out.printf(
                    "%d of %d random wirings compared: %s; events %s, refused %d, idle %d, not idle %d; %d of %d combinations of states reached; steps %s%n",
                    compared, seed, verdicts, events, refused, idle, notIdle, reached, 5 * compared, kinds);
        }
        assertThat(kinds.keySet())
                .as("kinds of steps")
                .containsAll(Stream.of(Step.class.getPermittedSubclasses())
                        .flatMap(RandomDeclarationsTest::records)
                        .toList())
                .contains("failsTo", "stops together", "stops alone");
        assertThat(verdicts.keySet()).containsExactlyInAnyOrder(Proved.class, Blocked.class, Deadlock.class);
        assertThat(verdicts.values()).as("%s", verdicts).allMatch(number -> number > compared / 20);
        assertThat(refused).as("events that are not allowed").isGreaterThan(compared / 2);
        assertThat(reached).as("reached combinations").isBetween(compared, 5 * compared - compared / 10);
        assertThat(idle).as("nothing is under way").isPositive();
        assertThat(notIdle).as("something is under way").isPositive();
    }

    private static Stream<String> records(Class<?> type) {
        return type.isSealed()
                ? Stream.of(type.getPermittedSubclasses()).flatMap(RandomDeclarationsTest::records)
                : Stream.of(type.getSimpleName());
    }

    private static void compareNet(Wiring wiring, Simulation simulation) {
        var net = wiring.net();
        var graph = ReachabilityGraph.explore(net);
        assertThat(List.of(graph.size(), graph.edgeCount(), graph.dead().size()))
                .as("states, steps and dead states of %s", describe(wiring))
                .containsExactly(simulation.worlds().size(), simulation.edges(), simulation.dead());
        assertThat(DeadlockSearch.run(net, SearchLimits.markings(graph.size())).deadlocks())
                .as("dead states by stubborn sets of %s", wiring.name())
                .hasSize(simulation.dead());
    }

    /** Components in some of their states at once, which may be reached or not. */
    private void compareQuestions(Wiring wiring, Simulation simulation, Random random) {
        var progress = WiringProgress.of(wiring);
        for (var i = 0; i < 5; i++) {
            var states = new TreeMap<String, Set<String>>();
            for (var component : wiring.components()) {
                var all = wiring.protocol(component).states();
                if (states.isEmpty() || random.nextInt(3) > 0) {
                    states.put(component, Set.of(all.get(random.nextInt(all.size()))));
                }
            }
            var distance = simulation.distance(states);
            var never = progress.never(states);
            var canReach = progress.canReach(states);
            assertThat(never)
                    .as(() -> states + " of " + describe(wiring))
                    .isInstanceOf(distance.isEmpty() ? Yes.class : No.class);
            assertThat(canReach)
                    .as(() -> states + " of " + describe(wiring))
                    .isInstanceOf(distance.isEmpty() ? No.class : Yes.class);
            if (never instanceof No<Fails>(var fails) && canReach instanceof Yes<Fails> way) {
                reached++;
                assertThat(fails.firings()).hasSize(distance.orElseThrow());
                assertThat(way.proof()).isEqualTo(fails.toString());
            }
        }
    }

    private void compareVerdict(Wiring wiring, Simulation simulation) {
        Class<?> expected =
                simulation.dead() > 0 ? Deadlock.class : simulation.blocked().isEmpty() ? Proved.class : Blocked.class;
        assertThat(WiringCheck.check(wiring)).as(() -> describe(wiring)).isInstanceOf(expected);
        verdicts.merge(expected, 1, Integer::sum);
    }

    /** Follows a random run; in between and at its end come events that may be foreign to it. */
    private void compareMonitor(Wiring wiring, Simulation simulation, Random random) {
        var observed = random.nextBoolean() ? Set.of("x") : Set.<String>of();
        var all = new TreeSet<String>();
        var foreign = simulation.worlds().stream()
                .flatMap(world -> simulation.moves(world).stream())
                .flatMap(move -> move.seen(observed).stream())
                .filter(event -> all.add(event.toString()))
                .toList();
        var monitor = WiringMonitor.of(wiring).observing(observed);
        var allowed = List.<ProtocolEvent>of();
        var world = simulation.start();
        var now = simulation.closed(Set.of(world), observed);
        for (var i = 0; i < EVENTS && !simulation.moves(world).isEmpty(); i++) {
            if (!foreign.isEmpty() && random.nextInt(4) == 0) {
                compareForeign(wiring, simulation, now, foreign.get(random.nextInt(foreign.size())), observed, allowed);
            }
            var moves = simulation.moves(world);
            var move = moves.get(random.nextInt(moves.size()));
            world = move.next();
            if (move.seen(observed).isEmpty() || move.mayBeUnseen() && random.nextBoolean()) {
                continue;
            }
            var event = move.seen(observed).orElseThrow();
            events.merge(event.kind(), 1, Integer::sum);
            now = simulation.after(now, event, observed);
            monitor.on(event);
            allowed = Stream.concat(allowed.stream(), Stream.of(event)).toList();
            assertThat(now).as("%s", allowed).contains(world);
            var isDead = now.stream().allMatch(simulation::isDead);
            assertThat(monitor.violation().isPresent())
                    .as(() -> "a deadlock after " + monitor.events() + " of " + describe(wiring))
                    .isEqualTo(isDead);
            if (isDead) {
                return;
            }
        }
        compareIdle(wiring, simulation, now, monitor);
    }

    private void compareForeign(
            Wiring wiring,
            Simulation simulation,
            Set<World> now,
            ProtocolEvent event,
            Set<String> observed,
            List<ProtocolEvent> before) {
        var monitor = WiringMonitor.of(wiring).observing(observed);
        before.forEach(monitor::on);
        monitor.on(event);
        var after = simulation.after(now, event, observed);
        assertThat(monitor.violation().isEmpty())
                .as(() -> event + " is allowed after " + before + " of " + describe(wiring) + ", not: "
                        + monitor.violation())
                .isEqualTo(after.stream()
                        .anyMatch(world -> !simulation.moves(world).isEmpty()));
        refused += after.isEmpty() ? 1 : 0;
    }

    private void compareIdle(Wiring wiring, Simulation simulation, Set<World> now, WiringMonitor monitor) {
        var isUnderWay = now.stream().allMatch(simulation::isUnderWay);
        monitor.idle();
        assertThat(monitor.violation().isPresent())
                .as(() -> "something is under way after " + monitor.events() + " of " + describe(wiring) + ": "
                        + monitor.violation())
                .isEqualTo(isUnderWay);
        if (isUnderWay) {
            notIdle++;
        } else {
            idle++;
        }
    }

    private static String describe(Wiring wiring) {
        var text = new StringBuilder(wiring.toString());
        for (var component : wiring.components()) {
            var protocol = wiring.protocol(component);
            text.append("\n").append(component).append(" fails to ").append(protocol.failure());
            protocol.steps().forEach(step -> text.append("\n  ").append(step));
            text.append("\n  ").append(wiring.mailbox(component));
        }
        return text.toString();
    }
}
