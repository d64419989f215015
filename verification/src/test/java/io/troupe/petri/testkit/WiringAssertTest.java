package io.troupe.petri.testkit;

import static io.troupe.petri.testkit.WiringAssert.assertThat;
import static io.troupe.petri.wiring.Protocol.acquires;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.releases;
import static io.troupe.petri.wiring.Protocol.requests;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.petri.SearchLimits;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringBuilder;
import org.junit.jupiter.api.Test;

/** What the assertion accepts, and its messages when it fails. */
class WiringAssertTest {
    private static Protocol client() {
        return Protocol.of("client")
                .state("idle", requests("planner.plan").then("idle"))
                .build();
    }

    private static Protocol planner() {
        return Protocol.of("planner")
                .state("ready", provides("plan").then("ready"))
                .build();
    }

    @Test
    void components_neverDeadlock() {
        assertThat(Wiring.of("demo").component(client()).component(planner()).build())
                .cannotDeadlock();
    }

    private static Protocol holder(String name, String first, String second) {
        return Protocol.of(name)
                .state("idle", acquires(first).then("begun"))
                .state("begun", acquires(second).then("working"))
                .state("working", releases(first).then("done"))
                .state("done", releases(second).then("idle"))
                .build();
    }

    private static WiringBuilder hands() {
        return Wiring.of("hands")
                .component(holder("left", "arm", "camera"))
                .component(holder("right", "camera", "arm"))
                .resource("arm", 1)
                .resource("camera", 1);
    }

    @Test
    void failure_tellsTheStory() {
        var wiring = hands().build();
        assertThatThrownBy(() -> assertThat(wiring).as("two hands").cannotDeadlock())
                .isInstanceOf(AssertionError.class)
                .hasMessage("""
                        [two hands] wiring hands can deadlock:
                        left waits for camera, which right holds; right waits for arm, which left holds
                          after 2 steps:
                            1. left takes arm
                            2. right takes camera
                          then:
                            * left waits for camera, which right holds
                            * right waits for arm, which left holds""");
    }

    @Test
    void componentsThatWaitWhileAnotherGoesOn_failOnlyTheStrongerAssertion() {
        var clock = Protocol.of("clock")
                .state("ticking", does("tick").then("ticking"))
                .build();
        var wiring = hands().component(clock).build();
        assertThat(wiring).neverStopsAsAWhole();
        assertThatThrownBy(() -> assertThat(wiring).cannotDeadlock())
                .hasMessageStartingWith("wiring hands lets components wait for ever while others may go on:\n"
                        + "left waits for camera, which right holds; right waits for arm, which left holds");
        assertThatThrownBy(() -> assertThat(hands().build()).neverStopsAsAWhole())
                .hasMessageContaining("wiring hands can deadlock");
    }

    @Test
    void limits_thatAreTooSmall_areNamed() {
        var many = Wiring.of("many")
                .components("client", 4, client())
                .component(planner())
                .build();
        assertThatThrownBy(() -> assertThat(many)
                        .as("many clients")
                        .within(SearchLimits.markings(2))
                        .cannotDeadlock())
                .hasMessageStartingWith("[many clients] wiring many")
                .hasMessageContaining("expected larger limits, as in assertThat(wiring).within(limits)");
    }

    @Test
    void nothing_isRefused() {
        assertThatThrownBy(() -> assertThat((Wiring) null).cannotDeadlock()).hasMessageContaining("not to be null");
    }
}
