package io.troupe.petri.wiring;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.wiring.WiringMonitor.ViolationException;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.Set;
import java.util.regex.Pattern;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

class WiringMonitorTest {
    private final Wiring wiring = Wiring.of("demo")
            .components(
                    "client",
                    2,
                    Protocol.of("client")
                            .state("idle", does("look").then("informed"))
                            .state("informed", requests("planner.plan").then("idle"))
                            .build())
            .component(
                    "planner",
                    Protocol.of("planner")
                            .state("ready", provides("plan").then("storing"))
                            .state(
                                    "storing",
                                    does("store").then("ready"),
                                    does("forget").then("ready"))
                            .build())
            .build();

    private final WiringMonitor monitor = WiringMonitor.of(wiring);

    @Test
    void samples() {
        var wiring = this.wiring;
        var monitor = WiringMonitor.of(wiring);
        monitor.asked("client1", "planner.plan");
        monitor.taken("client1", "planner.plan");
        monitor.answered("client1", "planner.plan");
        monitor.idle();
        monitor.check();

        monitor = monitor.keepingEvents();
        for (var client : List.of("client1", "client2", "client1")) {
            monitor.called(client, "planner.plan");
        }
        var all = monitor;
        assertThatThrownBy(() -> {
                    var runs = new Conformance(wiring, Set.of());
                    runs.add(all.events());
                    assertThat(runs.problems()).isEmpty();
                    assertThat(runs.unused()).isEmpty();
                })
                .hasMessageContaining("does forget"); // one of two private steps to the same state
    }

    @Test
    void allowedRun_hasNoViolation() {
        monitor.asked("client1", "planner.plan");
        monitor.asked("client2", "planner.plan");
        monitor.taken("client2", "planner.plan");
        assertThat(monitor.describe("planner")).isEqualTo("planner answers plan to client2");
        monitor.answered("client2", "planner.plan");
        assertThat(monitor.describe("planner")).isEqualTo("planner is in \"ready\" or is in \"storing\"");
        monitor.taken("client1", "planner.plan");
        monitor.answered("client1", "planner.plan");
        monitor.idle();
        monitor.check();
        assertThat(monitor.events()).hasSize(6);
        assertThat(monitor.violation()).isEmpty();
        assertThat(monitor.count()).isEqualTo(6);
    }

    @Test
    void callThatIsMadeTwice_isAViolation_withItsStory() {
        monitor.asked("client2", "planner.plan");
        monitor.asked("client1", "planner.plan");
        monitor.asked("client1", "planner.plan");
        assertThatThrownBy(monitor::check)
                .isInstanceOf(ViolationException.class)
                .hasMessage("""
                        the program does not do what the wiring "demo" declares: \
                        client1 asks planner.plan is not allowed: client1 waits for planner.plan, which is not accepted \
                        yet, where it may have planner.plan accepted
                          after:
                            - client2 asks planner.plan
                            - client1 asks planner.plan
                          then:
                            * client1 asks planner.plan
                          meanwhile:
                            * client2 waits for planner.plan, which is not accepted yet""");
    }

    /** A dependency that is not declared; only if neither side is known it is none. */
    @Test
    void callToOrFromAnActorThatTheWiringDoesNotHave_isAViolation() {
        monitor.asked("client1", "store.get");
        assertThatThrownBy(monitor::check)
                .hasMessageContaining("client1 asks store.get is not allowed: the wiring has no component store; ");
        assertThat(monitor.violation().orElseThrow().component()).isEqualTo("client1");
        var other = monitor.again();
        other.asked("stranger", "planner.plan");
        assertThatThrownBy(other::check)
                .hasMessageContaining(
                        "stranger asks planner.plan is not allowed: the wiring has no component stranger;");
        assertThat(other.violation().orElseThrow().component()).isEqualTo("planner");
        var again = monitor.again();
        assertThatThrownBy(() -> again.asked("stranger", "store.get"))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("there is no component stranger");
        assertThat(again.violation()).isEmpty();
    }

    @Test
    void answerToAnotherCaller_isAViolationOfTheCallerThatWasNotServed() {
        monitor.asked("client1", "planner.plan");
        monitor.asked("client2", "planner.plan");
        monitor.taken("client1", "planner.plan");
        monitor.answered("client2", "planner.plan");
        assertThat(monitor.violation().orElseThrow().component()).isEqualTo("client2");
    }

    @Test
    void callThatIsAcceptedWhileAnotherIsServed_isAViolationOfTheProvider() {
        monitor.asked("client1", "planner.plan");
        monitor.asked("client2", "planner.plan");
        monitor.taken("client1", "planner.plan");
        monitor.taken("client2", "planner.plan");
        var found = monitor.violation().orElseThrow();
        assertThat(found.component()).isEqualTo("planner");
        assertThat(found.problem())
                .isEqualTo("planner takes plan from client2 is not allowed: planner answers plan to client1, where it"
                        + " may answer plan");
    }

    @Test
    void missingAnswer_isFoundWhenNothingHappensAnyMore() {
        monitor.asked("client1", "planner.plan");
        monitor.taken("client1", "planner.plan");
        assertThat(monitor.violation()).isEmpty();
        monitor.idle();
        assertThat(monitor.violation().orElseThrow().toString())
                .startsWith("client1 waits for the answer of planner.plan, and nothing happens any more")
                .contains("meanwhile:\n    * planner answers plan to client1");
    }

    @Test
    void observedStep_mustBeReportedWhereItIsDeclared() {
        var precise = monitor.observing(Set.of("store"));
        precise.did("planner", "store");
        assertThat(precise.violation().orElseThrow().problem())
                .isEqualTo("planner: store is not allowed: planner is in \"ready\", where it may take plan");

        var again = monitor.observing(Set.of("store"));
        again.called("client1", "planner.plan");
        again.did("planner", "store");
        again.called("client1", "planner.plan");
        again.called("client2", "planner.plan"); // it has forgotten, which is not observed
        assertThat(again.violation()).isEmpty();
        assertThatThrownBy(() -> again.did("planner", "forget")).hasMessageContaining("forget", "[store]");
    }

    @Test
    void forbiddenCombination_isAViolation_andAtEndNothingIs() {
        monitor.never("both ask at once", Map.of("client1", Set.of("informed"), "client2", Set.of("informed")));
        monitor.asked("client1", "planner.plan");
        assertThat(monitor.violation()).as("the other one may be idle").isEmpty();
        monitor.taken("client1", "planner.plan");
        monitor.asked("client2", "planner.plan");
        assertThat(monitor.violation().orElseThrow().problem())
                .isEqualTo(
                        "both ask at once: client1 waits for the answer of planner.plan, client2 waits for planner.plan,"
                                + " which is not accepted yet");
        assertThatThrownBy(() -> monitor.never("x", Map.of("planner", Set.of("redy"))))
                .hasMessageContaining("ready");

        var ended = WiringMonitor.of(wiring);
        ended.end();
        ended.answered("client1", "planner.plan");
        assertThat(ended.violation()).isEmpty();
    }

    @Test
    void unknownNames_areTold_withTheNearestName() {
        assertThatThrownBy(() -> monitor.asked("client1", "plan")).hasMessageContaining("component.call");
        assertThatThrownBy(() -> monitor.asked("client3", "planer.plan")).hasMessageContaining("client3", "client1");
        monitor.asked("client1", "planer.plan");
        assertThatThrownBy(monitor::check).hasMessageContaining("no component planer; did you mean planner");
    }

    /** The names of the net's transitions are the events, so the monitor can be compared with the net. */
    @ParameterizedTest
    @ValueSource(ints = {1, 2, 3, 4, 5, 6, 7, 8})
    void firingSequencesOfTheNet_areAllowed_andMissingEventsFound(int seed) {
        var random = new Random(seed);
        var paper = PaperWiring.wiring();
        var followed = WiringMonitor.of(paper).keepingEvents();
        var state = ReachabilityGraph.explore(paper.net()).states().get(0);
        for (var i = 0; i < 400 && !state.successors().isEmpty(); i++) {
            var edge = state.successors().get(random.nextInt(state.successors().size()));
            report(edge.transition().name(), followed);
            state = edge.target();
        }
        assertThat(followed.violation()).as("seed " + seed).isEmpty();

        var runs = new Conformance(paper, Set.of());
        runs.add(followed.events());
        assertThat(runs.problems()).isEmpty();
        assertThat(runs.used())
                .allSatisfy(step ->
                        assertThat(runs.without(step)).as(step.toString()).isPresent());
        // each event but the last was needed: some later one is impossible without it, or it is the caller's last
        var events = followed.events();
        var missing = random.nextInt(Math.max(1, events.size() / 2));
        var partial = WiringMonitor.of(paper);
        for (var i = 0; i < events.size(); i++) {
            if (i != missing) {
                partial.on(events.get(i));
            }
        }
        var later = events.subList(missing + 1, events.size());
        var left = events.get(missing);
        if (later.stream().anyMatch(each -> each.component().equals(left.component()))) {
            assertThat(partial.violation())
                    .as("seed " + seed + " without " + left)
                    .isPresent();
        }
    }

    private static final Pattern ASKS = Pattern.compile("(\\w+) asks (\\w+\\.\\w+)");
    private static final Pattern TAKES = Pattern.compile("(\\w+) takes (\\w+) from (\\w+)");
    private static final Pattern ANSWERS = Pattern.compile("(\\w+) answers (\\w+) to (\\w+)");

    private static void report(String transition, WiringMonitor to) {
        var asks = ASKS.matcher(transition);
        var takes = TAKES.matcher(transition);
        var answers = ANSWERS.matcher(transition);
        if (asks.matches()) {
            to.asked(asks.group(1), asks.group(2));
        } else if (takes.matches()) {
            to.taken(takes.group(3), takes.group(1) + "." + takes.group(2));
        } else if (answers.matches()) {
            to.answered(answers.group(3), answers.group(1) + "." + answers.group(2));
        }
    }

    @Test
    void conformance_listsWhatTheRunsNeed() {
        var declared = Wiring.of("pictures")
                .component(Protocol.of("camera")
                        .state(
                                "on",
                                requests("store.keep").then("on"),
                                does("switch off").then("off"))
                        .state("off", does("switch on").then("on"))
                        .build())
                .component(Protocol.of("store")
                        .state("open", provides("keep").then("open"))
                        .build())
                .build();
        var observed = Set.of("switch off", "switch on");
        var followed = WiringMonitor.of(declared).observing(observed).keepingEvents();
        followed.called("camera", "store.keep");
        followed.did("camera", "switch off");

        var runs = new Conformance(declared, observed);
        runs.add(followed.events());
        runs.add(List.of(new ProtocolEvent(ProtocolEvent.Kind.DID, "camera", "switch off")));
        assertThat(runs.problems()).isEmpty();
        assertThat(runs.unused()).extracting(Object::toString).containsExactly("camera: \"off\" does switch on \"on\"");
        assertThat(runs.used())
                .extracting(Object::toString)
                .containsExactly(
                        "camera: \"on\" requests store.keep \"on\"",
                        "camera: \"on\" does switch off \"off\"",
                        "store: \"open\" provides keep \"open\"");
        assertThat(runs.without(runs.used().get(2)))
                .hasValue(
                        "store takes keep from camera as event 2 of a run, after: camera asks store.keep; but store is in"
                                + " \"open\", where it may do nothing");
    }
}
