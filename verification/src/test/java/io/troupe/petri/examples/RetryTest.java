package io.troupe.petri.examples;

import static io.troupe.petri.wiring.Protocol.accepts;
import static io.troupe.petri.wiring.Protocol.answered;
import static io.troupe.petri.wiring.Protocol.answers;
import static io.troupe.petri.wiring.Protocol.asks;
import static io.troupe.petri.wiring.Protocol.cancels;
import static io.troupe.petri.wiring.Protocol.does;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.wiring.Branch;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringResult;
import org.junit.jupiter.api.Test;

/** A client that does not wait longer than some time, and asks again: it has to cancel what it does not wait for. */
class RetryTest {
    private static Wiring retry(Branch givesUp) {
        var client = Protocol.of("client")
                .state("idle", asks("planner.plan").then("waiting"))
                .state("waiting", answered("planner.plan").then("idle"), givesUp)
                .build();
        var planner = Protocol.of("planner")
                .state("ready", accepts("plan").then("planning"))
                .state("planning", does("look at the map").then("planned"))
                .state("planned", answers("plan").then("ready"))
                .build();
        return Wiring.of("retry").component(client).component(planner).build();
    }

    @Test
    void clientThatForgetsItsQuestion_isNotAnsweredAgain() {
        assertThat(WiringCheck.check(retry(does("time out").then("idle"))))
                .asString()
                .contains("""
                client waits for planner.plan, which no component will answer; planner (ready) waits to be called: \
                plan by client, which no component will do
                  after 5 steps:
                    1. client asks planner.plan and goes on
                    2. planner accepts plan of client, which goes on
                    3. planner: look at the map
                    4. planner answers plan to client, which goes on
                    5. client: time out
                  then:
                    * client waits for planner.plan
                    * planner (ready) waits to be called: plan by client
                """);
    }

    @Test
    void clientThatCancelsItsQuestion_goesOn() {
        assertThat(WiringCheck.check(retry(cancels("planner.plan").then("idle"))))
                .isInstanceOf(WiringResult.Proved.class);
    }
}
