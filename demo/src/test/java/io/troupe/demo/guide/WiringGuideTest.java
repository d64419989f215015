package io.troupe.demo.guide;

import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Composition;
import io.troupe.petri.Liveness;
import io.troupe.petri.Meld;
import io.troupe.petri.PetriNet;
import io.troupe.petri.Pnml;
import io.troupe.petri.ReachabilityGraph;
import io.troupe.petri.Verdict;
import io.troupe.petri.structure.DeadlockVerdict;
import io.troupe.petri.structure.SiphonAnalysis;
import io.troupe.petri.wiring.PaperWiring;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringResult.Deadlock;
import io.troupe.petri.wiring.WiringResult.Proved;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/** The samples of docs/guide/03-proving-a-wiring.md. */
class WiringGuideTest {
    private static Protocol camera() {
        var camera = Protocol.of("camera")
                .in(
                        "idle",
                        does("take a picture").then("holding"),
                        provides("pause").then("paused"))
                .in("holding", requests("store.keep").then("idle"))
                .in("paused", does("wake up").then("idle"))
                .build();
        return camera;
    }

    private static Protocol store() {
        var store = Protocol.of("store")
                .in("open", provides("keep").then("checking"))
                .in(
                        "checking",
                        does("find room").then("open"),
                        does("find none").then("full"))
                .in("full", requests("camera.pause").then("open"))
                .build();
        return store;
    }

    private static Protocol boundedStore() {
        var store = Protocol.of("store")
                .in("open", provides("keep").then("checking"))
                .in(
                        "checking",
                        does("find room").then("open"),
                        does("drop the oldest").then("open"))
                .build();
        return store;
    }

    /** The wiring of the guide deadlocks; the guide shows the repaired one too. */
    @Test
    void cameraAndStore_deadlockInACircle() {
        var wiring =
                Wiring.of("pictures").component(camera()).component(store()).build();
        var result = WiringCheck.check(wiring);
        assertThat(result).isInstanceOf(Deadlock.class);
        assertThat(result.toString()).startsWith("""
                        can deadlock: 14 places, 12 transitions, 32 arcs; 17 markings, 24 edges, 1 dead; 13 markings by stubborn sets, 1 dead and no others
                        camera waits for store.keep; store waits for camera.pause: all ask and nobody answers
                          after 9 steps:
                            1. camera: take a picture
                            2. camera asks store.keep
                            3. store takes keep from camera
                            4. store does keep
                            5. store answers keep to camera
                            6. store: find none
                            7. store asks camera.pause
                            8. camera: take a picture
                            9. camera asks store.keep
                          then:
                            * camera waits for store.keep
                            * store waits for camera.pause
                        """.stripTrailing());
    }

    private static Protocol tireless() {
        return Protocol.of("camera")
                .in("idle", does("take a picture").then("holding"))
                .in("holding", requests("store.keep").then("idle"))
                .build();
    }

    @Test
    void components_neverDeadlock() {
        var wiring = Wiring.of("pictures")
                .component(tireless())
                .component(boundedStore())
                .build();
        assertThat(WiringCheck.check(wiring)).isInstanceOf(Proved.class);
    }

    @Test
    void sixCameras_ofOneStore_areProved() {
        var wiring = Wiring.of("six cameras")
                .components("camera", 6, tireless())
                .component(boundedStore())
                .build();
        assertThat(WiringCheck.check(wiring)).isInstanceOf(Proved.class);
    }

    @Test
    void papersWiring_isRepairedByASynchronisedStop() {
        var result = (Deadlock) WiringCheck.check(PaperWiring.wiring());
        var repair = result.repair().orElseThrow();

        assertThat(repair.isProved()).isTrue();
        assertThat(repair.stops()).containsEntry("player", List.of("ready"));
    }

    @Test
    void netsByHand_areComposedSearchedAndWritten(@TempDir Path directory) {
        var asking = PetriNet.builder("asking")
                .place("free", 1)
                .place("busy")
                .transition("ask", List.of("free"), List.of("busy"))
                .transition("finish", List.of("busy"), List.of("free"))
                .build();
        var answering = PetriNet.builder("answering")
                .place("ready", 1)
                .transition("answer", List.of("ready"), List.of("ready"))
                .build();
        var net = Composition.compose("both", List.of(asking, answering), List.of(Meld.of("ask", "answer")));

        var graph = ReachabilityGraph.explore(net);
        assertThat(graph.deadlockFree()).isEqualTo(Verdict.YES);
        assertThat(Liveness.of(graph).reversible()).isEqualTo(Verdict.YES);
        assertThat(SiphonAnalysis.of(net).deadlock()).isInstanceOf(DeadlockVerdict.NoDeadMarking.class);

        Pnml.write(net, directory.resolve("both.pnml"));
        assertThat(Pnml.read(directory.resolve("both.pnml")).sameStructureAs(net))
                .isTrue();
    }
}
