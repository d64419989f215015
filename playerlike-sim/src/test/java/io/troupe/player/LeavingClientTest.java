package io.troupe.player;

import static io.troupe.sim.TestWorlds.robot;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.sim.Simulation;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.UnansweredTickException;
import io.troupe.sim.WorldSettings;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;
import java.util.stream.LongStream;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

/**
 * A client that closes itself during a tick: the rest of its turn belongs to that tick, and the world does not wait for
 * work that never ends.
 */
@Timeout(60)
class LeavingClientTest {
    private static final int PORT = 6780;
    private static final int TICKS = 20;

    private Simulation simulation = open();
    private final List<Long> ticksSeen = Collections.synchronizedList(new ArrayList<>());
    private final CountDownLatch never = new CountDownLatch(1);

    private static Simulation open() {
        return Simulation.open(
                TestWorlds.scenario(PORT, TestWorlds.world(List.of(robot("one", 0, 0, 0), robot("two", 0, 3, 0)))),
                WorldSettings.DEFAULT);
    }

    @AfterEach
    void close() {
        never.countDown();
        simulation.close();
    }

    private ActorSpace space(String name, Simulation world) {
        return ActorSpace.create(SpaceSettings.named(name).withClock(world.clock()));
    }

    private static PlayerClient connect() {
        var client = new PlayerClient("localhost", PORT);
        client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE).setSpeed(0.1, 0);
        client.runThreaded(-1, -1);
        return client;
    }

    /** At every reading: closes the client, runs the action, and connects again. */
    private void reconnectAlways(Runnable between) {
        PlayerClient client = connect();
        client.nextData()
                .thenAccept(ready -> {
                    ticksSeen.add(simulation.clock().nanos() / 100_000_000);
                    client.close();
                    ActorSpace.current()
                            .execute(
                                    () -> { // in a chain of turns that all belong to the tick
                                        between.run();
                                        reconnectAlways(between);
                                    });
                })
                .exceptionally(lost -> null);
    }

    private static List<Long> all(int ticks) {
        return LongStream.range(0, ticks).boxed().toList();
    }

    @Test
    void reconnectionInATurn_losesNoTick_howeverLongTheTurnTakes() throws Exception {
        var looks = new Semaphore(0);
        simulation.whileWaiting(looks::release);
        try (var space = space("slow", simulation)) {
            onSpace(
                    space,
                    () -> reconnectAlways(() -> {
                        looks.drainPermits();
                        // without waiting, the world would reach these polls only in later ticks
                        looks.acquireUninterruptibly(3);
                    }));
            ticks(TICKS);
            looks.release(1_000);
        }
        assertThat(ticksSeen).isEqualTo(all(TICKS));
    }

    @Test
    void reconnectionInATurn_losesNoTick_inAHundredRuns() throws Exception {
        for (int run = 0; run < 100; run++) {
            try (var space = space("fast", simulation)) {
                onSpace(space, () -> reconnectAlways(() -> {}));
                ticks(TICKS);
            }
            assertThat(ticksSeen).as("run " + run).isEqualTo(all(TICKS));
            ticksSeen.clear();
            simulation.close();
            simulation = open();
        }
    }

    @Test
    void devicesThatAreGivenBackAndTakenInATurn_loseNoTick() throws Exception {
        var looks = new Semaphore(0);
        simulation.whileWaiting(looks::release);
        try (var space = space("slow", simulation)) {
            onSpace(space, () -> {
                var client = connect();
                space.repeatWhile(
                                () -> true,
                                () -> client.nextData().thenAccept(ready -> {
                                    ticksSeen.add(simulation.clock().nanos() / 100_000_000);
                                    client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_CLOSE_MODE);
                                    looks.drainPermits();
                                    looks.acquireUninterruptibly(3);
                                    client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
                                }))
                        .exceptionally(lost -> null);
            });
            ticks(TICKS);
            looks.release(1_000);
        }
        assertThat(ticksSeen).isEqualTo(all(TICKS));
    }

    @Test
    void threadThatConnectsAnewBeforeItClosesTheOld_losesNoTick() throws Exception {
        var begun = new CountDownLatch(1);
        var thread = Thread.ofVirtual().start(() -> {
            try {
                var client = reader();
                begun.countDown();
                while (true) {
                    client.readAll();
                    ticksSeen.add(simulation.latest().tick());
                    var next = reader();
                    client.close();
                    client = next;
                }
            } catch (PlayerException closed) {
                begun.countDown();
            }
        });
        begun.await();
        ticks(TICKS);
        simulation.close();
        thread.join();
        assertThat(ticksSeen).isEqualTo(all(TICKS));
    }

    private static PlayerClient reader() {
        var client = new PlayerClient("localhost", PORT);
        client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
        return client;
    }

    // ---- the world does not wait for work that never ends

    @Test
    void turnThatDoesNotEnd_isNamed_orGivenUp() throws Exception {
        try (var space = space("thinker", simulation)) {
            onSpace(space, () -> {
                PlayerClient client = connect();
                client.nextData()
                        .thenAccept(ready -> {
                            client.close();
                            awaitQuietly(never);
                        })
                        .exceptionally(lost -> null);
            });
            simulation.answerLimit(Duration.ofMillis(20));
            assertThatThrownBy(simulation::tick)
                    .isInstanceOf(UnansweredTickException.class)
                    .hasMessageContaining("it has left; on actor space thinker");
            never.countDown();
        }
        ticks(1);
    }

    @Test
    void turnThatDoesNotEnd_isGivenUp_whereSilentClientsAreDisconnected() throws Exception {
        try (var space = space("thinker", simulation)) {
            onSpace(space, () -> {
                PlayerClient client = connect();
                client.nextData()
                        .thenAccept(ready -> {
                            client.close();
                            awaitQuietly(never);
                        })
                        .exceptionally(lost -> null);
            });
            simulation.disconnectSilentClients(true);
            simulation.answerLimit(Duration.ofMillis(20));
            ticks(2);
            assertThat(never.getCount()).as("the turn has not ended").isEqualTo(1);
            assertThat(simulation.latest().tick()).isEqualTo(2);
            assertThat(simulation.hasSubscribers()).isFalse();
            never.countDown();
        }
    }

    @Test
    void clientClosedByAnotherThread_isGoneAtOnce_howeverBusyItsSpaceIs() throws Exception {
        var busy = new CountDownLatch(1);
        var clients = new ArrayList<PlayerClient>();
        try (var space = space("thinker", simulation)) {
            onSpace(space, () -> {
                PlayerClient client = connect();
                clients.add(client);
                client.nextData()
                        .thenAccept(ready -> {
                            busy.countDown();
                            awaitQuietly(never);
                        })
                        .exceptionally(lost -> null);
            });
            var other = Thread.ofVirtual().start(() -> {
                awaitQuietly(busy);
                clients.getFirst().close();
            });
            simulation.answerLimit(Duration.ofMinutes(10));
            ticks(2);
            other.join();
            assertThat(never.getCount()).as("the turn has not ended").isEqualTo(1);
            assertThat(simulation.latest().tick()).isEqualTo(2);
            assertThat(simulation.hasSubscribers()).isFalse();
            never.countDown();
        }
    }

    @Test
    void loopThatPolls_andGoesOnWithoutItsClient_holdsNobodyUp() throws Exception {
        try (var space = space("polling", simulation)) {
            onSpace(space, () -> {
                PlayerClient client = new PlayerClient("localhost", PORT);
                var position = client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE);
                client.runThreaded(-1, -1);
                space.repeatWhile(() -> true, () -> {
                    if (ticksSeen.size() < 3 && position.isDataReady()) {
                        ticksSeen.add(simulation.clock().nanos() / 100_000_000);
                        if (ticksSeen.size() == 3) {
                            client.close();
                        }
                    }
                });
            });
            ticks(10);
        }
        assertThat(ticksSeen).isEqualTo(all(3));
    }

    @Test
    void spaceThatClosesItselfInItsTurn_isWaitedForNoLonger() throws Exception {
        var space = space("gone", simulation);
        onSpace(space, () -> {
            PlayerClient leaving = connect();
            connect(); // stays connected and never answers again
            leaving.nextData()
                    .thenAccept(ready -> {
                        leaving.close();
                        space.close();
                    })
                    .exceptionally(lost -> null);
        });
        ticks(3);
        assertThat(simulation.hasSubscribers()).isFalse();
    }

    @Test
    void simulationThatIsClosed_waitsForNoTurn() throws Exception {
        var left = new CountDownLatch(1);
        var space = space("thinker", simulation);
        onSpace(space, () -> {
            PlayerClient client = connect();
            client.nextData()
                    .thenAccept(ready -> {
                        client.close();
                        left.countDown();
                        awaitQuietly(never);
                    })
                    .exceptionally(lost -> null);
        });
        var other = Thread.ofVirtual().start(() -> {
            awaitQuietly(left);
            simulation.close();
        });
        simulation.answerLimit(Duration.ofMinutes(10));
        assertThatThrownBy(() -> ticks(2))
                .isInstanceOf(IllegalStateException.class)
                .hasMessageContaining("closed");
        other.join();
        never.countDown();
        space.close();
    }

    // ---- helpers

    private void ticks(int count) {
        for (int tick = 0; tick < count; tick++) {
            simulation.tick();
        }
    }

    private static void onSpace(ActorSpace space, Runnable task) throws InterruptedException {
        var done = new CountDownLatch(1);
        space.execute(task);
        space.execute(done::countDown);
        assertThat(done.await(30, TimeUnit.SECONDS)).isTrue();
    }

    private static void awaitQuietly(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
