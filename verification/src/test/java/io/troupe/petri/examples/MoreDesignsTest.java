package io.troupe.petri.examples;

import static io.troupe.petri.wiring.Protocol.answered;
import static io.troupe.petri.wiring.Protocol.asks;
import static io.troupe.petri.wiring.Protocol.does;
import static io.troupe.petri.wiring.Protocol.emits;
import static io.troupe.petri.wiring.Protocol.finished;
import static io.troupe.petri.wiring.Protocol.finishes;
import static io.troupe.petri.wiring.Protocol.provides;
import static io.troupe.petri.wiring.Protocol.receives;
import static io.troupe.petri.wiring.Protocol.requests;
import static io.troupe.petri.wiring.Protocol.sends;
import static io.troupe.petri.wiring.Protocol.streams;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.petri.Answer.No;
import io.troupe.petri.wiring.Branch;
import io.troupe.petri.wiring.Overflow;
import io.troupe.petri.wiring.Protocol;
import io.troupe.petri.wiring.Wiring;
import io.troupe.petri.wiring.WiringCheck;
import io.troupe.petri.wiring.WiringProgress;
import io.troupe.petri.wiring.WiringProgress.Fails;
import io.troupe.petri.wiring.WiringResult;
import java.util.Map;
import java.util.Set;
import org.junit.jupiter.api.Test;

/** Philosophers with a limit of time, a pipeline with feedback, and an action with a goal that can be cancelled. */
class MoreDesignsTest {
    private static Wiring philosophers(Protocol fork, Protocol philosopher) {
        return Wiring.of("table")
                .components("fork", 2, fork)
                .components("phil", 2, philosopher)
                .bindEach("phil", "left", i -> "fork" + i)
                .bindEach("phil", "right", i -> "fork" + (3 - i))
                .build();
    }

    @Test
    void forkThatIsServedAfterTheTimeOut_isLost() {
        var fork = Protocol.of("fork")
                .state("free", provides("take").then("taken"))
                .state("taken", provides("put").then("free"))
                .build();
        var philosopher = Protocol.of("phil")
                .state("thinking", requests("left.take").then("one"))
                .state("one", requests("right.take").then("both").orTimeout("tired"))
                .state("both", does("eat").then("full"))
                .state("full", requests("right.put").then("tired"))
                .state("tired", requests("left.put").then("thinking"))
                .build();
        assertThat(WiringCheck.check(philosophers(fork, philosopher)))
                .isInstanceOf(WiringResult.Blocked.class)
                .asString()
                .contains("""
                        phil2 waits for fork2.take, which no component will answer
                          after 5 steps:
                            1. phil1 calls fork1.take, which answers
                            2. phil1 asks fork2.take
                            3. fork2 takes take from phil1
                            4. phil1 times out: fork2.take is served after the timeout
                            5. phil2 asks fork2.take
                          then:
                              phil2 waits for fork2.take, whatever fork2 does
                        """);
    }

    /** A fork may be put back by one who does not have it. */
    @Test
    void forksThatAreAlwaysPutBack_areNeverLost_andTwoEatAtOnce() {
        var fork = Protocol.of("fork")
                .state("free", provides("take").then("taken"), provides("put").then("free"))
                .state("taken", provides("put").then("free"))
                .build();
        var philosopher = Protocol.of("phil")
                .state("thinking", requests("left.take").then("one").orTimeout("putting"))
                .state("one", requests("right.take").then("eating").orTimeout("putting"))
                .state("eating", does("eat").then("putting"))
                .state("putting", requests("left.put").then("half"))
                .state("half", requests("right.put").then("thinking"))
                .build();
        var table = philosophers(fork, philosopher);
        assertThat(WiringCheck.check(table)).isInstanceOf(WiringResult.Proved.class);
        var both = Map.of("phil1", Set.of("eating"), "phil2", Set.of("eating"));
        assertThat(((No<Fails>) WiringProgress.of(table).never(both)).counterexample())
                .hasToString("""
                        phil1 is eating, phil2 is eating
                          after 8 steps:
                            1. phil1 calls fork1.take, which answers
                            2. phil1 calls fork2.take, which answers
                            3. phil2 asks fork2.take
                            4. phil2 times out: fork2.take was not taken
                            5. phil2 calls fork2.put, which answers
                            6. phil2 calls fork1.put, which answers
                            7. phil2 calls fork2.take, which answers
                            8. phil2 calls fork1.take, which answers""");
    }

    private static Wiring pipeline(Overflow overflow) {
        var source = Protocol.of("source")
                .state(
                        "ready",
                        receives("feedback").then("ready"),
                        does("read an image").then("loaded"))
                .state("loaded", sends("filter.image").then("ready"))
                .build();
        var filter = Protocol.of("filter")
                .state("idle", receives("image").then("done"))
                .state("done", sends("source.feedback").then("idle"))
                .build();
        return Wiring.of("pipeline")
                .component(source)
                .component(filter)
                .mailbox("source", 1, overflow)
                .mailbox("filter", 1, overflow)
                .build();
    }

    @Test
    void pipelineWithFeedback_deadlocks_ifBothWaitForRoom() {
        assertThat(WiringCheck.check(pipeline(Overflow.BLOCK))).asString().contains("""
                source waits for room to send image to filter, which has not taken [image]; \
                filter waits for room to send feedback to source, which has not taken [feedback]
                """);
        assertThat(WiringCheck.check(pipeline(Overflow.DROP_OLDEST))).isInstanceOf(WiringResult.Proved.class);
    }

    /** @param whenIdle what the server does with a request to cancel a goal that has ended */
    private static Wiring action(Branch... whenIdle) {
        var client = Protocol.of("client")
                .state("idle", asks("server.goal").then("watching"))
                .state(
                        "watching",
                        answered("server.goal").then("watching"),
                        finished("server.goal").then("idle"),
                        does("change its mind").then("cancelling"))
                .state("cancelling", asks("server.cancel").then("leaving"))
                .state(
                        "leaving",
                        answered("server.goal").then("leaving"),
                        answered("server.cancel").then("cancelled"),
                        finished("server.goal").then("left"))
                .state(
                        "cancelled",
                        answered("server.goal").then("cancelled"),
                        finished("server.goal").then("idle"))
                .state("left", answered("server.cancel").then("idle"))
                .build();
        var idle = new Branch[whenIdle.length + 1];
        idle[0] = streams("goal").then("active");
        System.arraycopy(whenIdle, 0, idle, 1, whenIdle.length);
        var server = Protocol.of("server")
                .state("idle", idle)
                .state(
                        "active",
                        does("move").then("moved"),
                        does("arrive").then("ending"),
                        provides("cancel").then("ending"))
                .state("moved", emits("goal").then("active"))
                .state("ending", finishes("goal").then("idle"))
                .build();
        return Wiring.of("action").component(client).component(server).build();
    }

    @Test
    void cancellationThatCrossesTheEnd_isNotAnswered_unlessTheIdleServerAnswersToo() {
        assertThat(WiringCheck.check(action())).asString().contains("""
                client waits for server.cancel, which no component will answer; \
                server (idle) waits to be called: goal by client, which no component will do
                """);
        assertThat(WiringCheck.check(action(provides("cancel").then("idle")))).isInstanceOf(WiringResult.Proved.class);
    }
}
