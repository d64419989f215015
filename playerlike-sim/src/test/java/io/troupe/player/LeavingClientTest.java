package io.troupe.player;

import static io.troupe.sim.TestWorlds.robot;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
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
import java.util.Queue;
import java.util.Random;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.Semaphore;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import java.util.stream.LongStream;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Clients that close themselves during a tick: the rest of the turn belongs to that tick, and the world does not wait
 * for work that never ends, nor for a client that is gone, in whatever order clients, spaces and the simulation close.
 */
@Timeout(60)
class LeavingClientTest implements PlayerConstants {
    private static final int PORT = 6780;
    private static final int TICKS = 20;

    private Simulation simulation = open();
    private final List<Long> ticksSeen = Collections.synchronizedList(new ArrayList<>());
    private final CountDownLatch never = new CountDownLatch(1);
    private final Semaphore looks = new Semaphore(0);

    private static Simulation open() {
        return Simulation.open(
                TestWorlds.scenario(PORT, TestWorlds.world(List.of(robot("one", 0, 0, 0), robot("two", 0, 3, 0)))),
                WorldSettings.defaults());
    }

    @AfterEach
    void close() {
        never.countDown();
        simulation.close();
    }

    private ActorSpace space(String name) {
        return ActorSpace.create(SpaceSettings.named(name).withClock(simulation.clock()));
    }

    private static PlayerClient connect() {
        var client = new PlayerClient("localhost", PORT);
        client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE).setSpeed(0.1, 0);
        client.runThreaded(-1, -1);
        return client;
    }

    /** Connects a client on the space and runs the action in the turn of its first data. */
    private static void atFirstData(ActorSpace space, Consumer<PlayerClient> action) throws InterruptedException {
        onSpace(space, () -> {
            var client = connect();
            client.nextData().thenAccept(ready -> action.accept(client)).exceptionally(lost -> null);
        });
    }

    private static void onSpace(ActorSpace space, Runnable task) throws InterruptedException {
        var done = new CountDownLatch(1);
        space.execute(task);
        space.execute(done::countDown);
        assertThat(done.await(30, TimeUnit.SECONDS)).isTrue();
    }

    private void ticks(int count) {
        for (int tick = 0; tick < count; tick++) {
            simulation.tick();
        }
    }

    private void seeTick() {
        ticksSeen.add(simulation.clock().nanos() / 100_000_000);
    }

    private void assertTicksSeen(int count) {
        assertThat(ticksSeen).isEqualTo(LongStream.range(0, count).boxed().toList());
    }

    private static void awaitQuietly(CountDownLatch latch) {
        try {
            latch.await();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    // ---- no tick is lost

    /** Without waiting, the world would reach these polls only in later ticks. */
    private void awaitThreeLooks() {
        looks.drainPermits();
        looks.acquireUninterruptibly(3);
    }

    /** At every reading: closes the client, runs the action, and connects again. */
    private void reconnectAlways(Runnable between) {
        PlayerClient client = connect();
        Runnable thenAgain = () -> { // in a chain of turns that all belong to the tick
            between.run();
            reconnectAlways(between);
        };
        client.nextData()
                .thenAccept(ready -> {
                    seeTick();
                    client.close();
                    ActorSpace.current().execute(thenAgain);
                })
                .exceptionally(lost -> null);
    }

    @Test
    void reconnectionInATurn_losesNoTick_howeverLongTheTurnTakes_norInAHundredRuns() throws Exception {
        for (int run = 0; run <= 100; run++) {
            Runnable between = run == 0 ? this::awaitThreeLooks : () -> {};
            if (run == 0) {
                simulation.whileWaiting(looks::release);
            }
            try (var space = space("run " + run)) {
                onSpace(space, () -> reconnectAlways(between));
                ticks(TICKS);
                looks.release(1_000);
            }
            assertTicksSeen(TICKS);
            ticksSeen.clear();
            simulation.close();
            simulation = open();
        }
    }

    @Test
    void devicesThatAreGivenBackAndTakenInATurn_loseNoTick() throws Exception {
        simulation.whileWaiting(looks::release);
        try (var space = space("slow")) {
            onSpace(space, () -> {
                var client = connect();
                Runnable giveBackAndTake = () -> {
                    seeTick();
                    client.requestInterfacePosition2D(0, PLAYER_CLOSE_MODE);
                    awaitThreeLooks();
                    client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
                };
                space.repeatWhile(() -> true, () -> client.nextData().thenAccept(ready -> giveBackAndTake.run()))
                        .exceptionally(lost -> null);
            });
            ticks(TICKS);
            looks.release(1_000);
        }
        assertTicksSeen(TICKS);
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
        assertTicksSeen(TICKS);
    }

    private static PlayerClient reader() {
        var client = new PlayerClient("localhost", PORT);
        client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
        return client;
    }

    // ---- the world does not wait for work that never ends

    private void closeAndThink(PlayerClient client) {
        client.close();
        awaitQuietly(never);
    }

    private void assertGoneAfterTwoTicks() {
        assertThat(never.getCount()).as("the turn has not ended").isEqualTo(1);
        assertThat(simulation.latest().tick()).isEqualTo(2);
        assertThat(simulation.hasSubscribers()).isFalse();
        never.countDown();
    }

    @Test
    void turnThatDoesNotEnd_isNamed_orGivenUp() throws Exception {
        try (var space = space("thinker")) {
            atFirstData(space, this::closeAndThink);
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
        try (var space = space("thinker")) {
            atFirstData(space, this::closeAndThink);
            simulation.disconnectSilentClients(true);
            simulation.answerLimit(Duration.ofMillis(20));
            ticks(2);
            assertGoneAfterTwoTicks();
        }
    }

    @Test
    void clientClosedByAnotherThread_isGoneAtOnce_howeverBusyItsSpaceIs() throws Exception {
        var busy = new CountDownLatch(1);
        var clients = new ArrayList<PlayerClient>();
        try (var space = space("thinker")) {
            atFirstData(space, client -> {
                clients.add(client);
                busy.countDown();
                awaitQuietly(never);
            });
            var other = Thread.ofVirtual().start(() -> {
                awaitQuietly(busy);
                clients.getFirst().close();
            });
            simulation.answerLimit(Duration.ofMinutes(10));
            ticks(2);
            other.join();
            assertGoneAfterTwoTicks();
        }
    }

    @Test
    void loopThatPolls_andGoesOnWithoutItsClient_holdsNobodyUp() throws Exception {
        try (var space = space("polling")) {
            onSpace(space, () -> {
                var client = new PlayerClient("localhost", PORT);
                var position = client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE);
                client.runThreaded(-1, -1);
                space.repeatWhile(() -> true, () -> {
                    if (ticksSeen.size() < 3 && position.isDataReady()) {
                        seeTick();
                        if (ticksSeen.size() == 3) {
                            client.close();
                        }
                    }
                });
            });
            ticks(10);
        }
        assertTicksSeen(3);
    }

    @Test
    void spaceThatClosesItselfInItsTurn_isWaitedForNoLonger() throws Exception {
        var space = space("gone");
        atFirstData(space, leaving -> {
            leaving.close();
            space.close();
        });
        onSpace(space, LeavingClientTest::connect); // stays connected and never answers again
        ticks(3);
        assertThat(simulation.hasSubscribers()).isFalse();
    }

    @Test
    void simulationThatIsClosed_waitsForNoTurn() throws Exception {
        var left = new CountDownLatch(1);
        try (var space = space("thinker")) {
            atFirstData(space, client -> {
                client.close();
                left.countDown();
                awaitQuietly(never);
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
        }
    }

    // ---- random orders, which follow from the seed, on the threads of the spaces and on others

    private final Queue<Throwable> errors = new ConcurrentLinkedQueue<>();
    private final Queue<Thread> others = new ConcurrentLinkedQueue<>();

    /** Several clients on one space; everything but the construction runs on the thread of the space. */
    private final class Troop {
        final boolean threadless;
        final ActorSpace space;
        final Random random;
        final List<PlayerClient> clients = new ArrayList<>();

        Troop(boolean threadless, long seed) {
            this.threadless = threadless;
            this.random = new Random(seed);
            var settings = SpaceSettings.named("troop " + seed)
                    .withClock(simulation.clock())
                    .withOnDeadLetter(letter -> {})
                    .withOnError((where, error) -> note(error));
            this.space = ActorSpace.create(threadless ? settings.withoutThread() : settings);
        }

        void begin(int count) throws InterruptedException {
            var begun = new CountDownLatch(1);
            space.execute(() -> {
                for (int client = 0; client < count; client++) {
                    join();
                }
                begun.countDown();
            });
            if (threadless) {
                space.runQueued();
            }
            assertThat(begun.await(30, TimeUnit.SECONDS)).isTrue();
        }

        void join() {
            var client = new PlayerClient("localhost", PORT);
            client.requestInterfacePosition2D(random.nextInt(2), PLAYER_OPEN_MODE);
            client.runThreaded(-1, -1);
            clients.add(client);
            goOn(client);
        }

        private void goOn(PlayerClient client) {
            client.nextData().thenAccept(ready -> act(client)).exceptionally(lost -> {
                note(lost);
                return null;
            });
        }

        private void act(PlayerClient client) {
            switch (random.nextInt(30)) {
                case 0 -> client.close();
                case 1, 2, 3 -> {
                    client.close();
                    later(random.nextInt(3), this::join);
                }
                case 4 -> clients.get(random.nextInt(clients.size())).close();
                case 5 -> {
                    client.close();
                    space.close();
                }
                case 6 -> space.close();
                case 7 -> byAnother(client::close);
                case 8 -> {
                    if (!threadless) {
                        byAnother(space::close);
                    }
                }
                case 9 -> {
                    byAnother(client::close);
                    client.close();
                    later(1, this::join);
                }
                case 10, 11 -> {
                    client.requestInterfacePosition2D(0, PLAYER_CLOSE_MODE);
                    client.requestInterfacePosition2D(1, PLAYER_CLOSE_MODE);
                    later(1, () -> client.requestInterfacePosition2D(0, PLAYER_OPEN_MODE));
                }
                default -> {}
            }
            goOn(client);
        }

        private void later(int turns, Runnable action) {
            space.execute(turns == 0 ? action : () -> later(turns - 1, action));
        }
    }

    private void byAnother(Runnable action) {
        others.add(Thread.ofVirtual().start(action));
    }

    /** Counts errors that report something closed; any other error fails the test. */
    private void note(Throwable error) {
        if (!(error instanceof PlayerException) && !(error instanceof ActorStoppedException)) {
            errors.add(error);
        }
    }

    @ParameterizedTest(name = "seeds from {0}")
    @ValueSource(longs = {1, 1_001, 2_001})
    void worldGoesOn_inWhateverOrderClientsAndSpacesClose(long firstSeed) throws Exception {
        for (long seed = firstSeed; seed < firstSeed + 50; seed++) {
            simulation.close();
            simulation = open();
            leaveInRandomOrder(seed);
            assertThat(errors).as("seed " + seed).isEmpty();
        }
    }

    private void leaveInRandomOrder(long seed) throws Exception {
        var random = new Random(seed);
        List<Troop> troops = new ArrayList<>();
        try {
            for (int troop = 1 + random.nextInt(3); troop > 0; troop--) {
                troops.add(new Troop(random.nextBoolean(), seed * 10 + troop));
            }
            List<Troop> threadless =
                    troops.stream().filter(each -> each.threadless).toList();
            if (!threadless.isEmpty()) {
                simulation.whileWaiting(() -> threadless.forEach(each -> each.space.runQueued()));
            }
            for (var troop : troops) {
                troop.begin(1 + random.nextInt(3));
            }
            int closingTick = random.nextInt(50);
            for (int tick = 0; tick < 25; tick++) {
                if (tick == closingTick) {
                    byAnother(simulation::close);
                }
                simulation.tick();
            }
        } catch (IllegalStateException closedMeanwhile) {
            assertThat(closedMeanwhile).as("seed " + seed).hasMessageContaining("closed");
        } catch (RuntimeException e) {
            throw new AssertionError("seed " + seed, e);
        } finally {
            simulation.close();
        }
        for (Thread other : others) {
            other.join();
        }
        others.clear();
        troops.forEach(each -> each.space.close());
    }
}
