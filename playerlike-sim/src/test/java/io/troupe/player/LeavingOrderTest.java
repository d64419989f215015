package io.troupe.player;

import static io.troupe.sim.TestWorlds.robot;
import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.ActorStoppedException;
import io.troupe.actor.SpaceSettings;
import io.troupe.player.structures.PlayerConstants;
import io.troupe.sim.Simulation;
import io.troupe.sim.TestWorlds;
import io.troupe.sim.WorldSettings;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.Random;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/**
 * Clients, spaces and the simulation close in random order, from their own turns and from other threads; the world
 * never waits for a client that is gone. The order follows from the seed.
 */
@Timeout(60)
class LeavingOrderTest {
    private static final int PORT = 6785;
    private static final int RUNS = 50;
    private static final int TICKS = 25;

    private final Queue<Throwable> errors = new ConcurrentLinkedQueue<>();
    private final Queue<Thread> others = new ConcurrentLinkedQueue<>();

    /** Several clients on one space; everything but the construction runs on the thread of the space. */
    private final class Troop {
        final boolean cranked;
        final ActorSpace space;
        final Random random;
        final List<PlayerClient> clients = new ArrayList<>();

        Troop(Simulation simulation, boolean cranked, long seed) {
            this.cranked = cranked;
            this.random = new Random(seed);
            var settings = SpaceSettings.named("troop " + seed)
                    .withClock(simulation.clock())
                    .withOnDeadLetter(letter -> {})
                    .withOnError((where, error) -> note(error));
            this.space = ActorSpace.create(cranked ? settings.withHandCrank() : settings);
        }

        void join() {
            var client = new PlayerClient("localhost", PORT);
            client.requestInterfacePosition2D(random.nextInt(2), PlayerConstants.PLAYER_OPEN_MODE);
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
                    if (!cranked) {
                        byAnother(space::close);
                    }
                }
                case 9 -> {
                    byAnother(client::close);
                    client.close();
                    later(1, this::join);
                }
                case 10, 11 -> {
                    client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_CLOSE_MODE);
                    client.requestInterfacePosition2D(1, PlayerConstants.PLAYER_CLOSE_MODE);
                    later(1, () -> client.requestInterfacePosition2D(0, PlayerConstants.PLAYER_OPEN_MODE));
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
        for (long seed = firstSeed; seed < firstSeed + RUNS; seed++) {
            run(seed);
            assertThat(errors).as("seed " + seed).isEmpty();
        }
    }

    private void run(long seed) throws Exception {
        var random = new Random(seed);
        List<Troop> troops = new ArrayList<>();
        try (var simulation = Simulation.open(
                TestWorlds.scenario(PORT, TestWorlds.world(List.of(robot("one", 0, 0, 0), robot("two", 0, 3, 0)))),
                WorldSettings.DEFAULT)) {
            for (int troop = 1 + random.nextInt(3); troop > 0; troop--) {
                troops.add(new Troop(simulation, random.nextBoolean(), seed * 10 + troop));
            }
            List<Troop> cranked = troops.stream().filter(each -> each.cranked).toList();
            if (!cranked.isEmpty()) {
                simulation.whileWaiting(() -> cranked.forEach(each -> each.space.crank()));
            }
            for (var troop : troops) {
                begin(troop, 1 + random.nextInt(3));
            }
            int closingTick = random.nextInt(2 * TICKS);
            for (int tick = 0; tick < TICKS; tick++) {
                if (tick == closingTick) {
                    byAnother(simulation::close);
                }
                simulation.tick();
            }
        } catch (IllegalStateException closedMeanwhile) {
            assertThat(closedMeanwhile).as("seed " + seed).hasMessageContaining("closed");
        } catch (RuntimeException e) {
            throw new AssertionError("seed " + seed, e);
        }
        for (Thread other : others) {
            other.join();
        }
        others.clear();
        troops.forEach(each -> each.space.close());
    }

    private static void begin(Troop troop, int clients) throws InterruptedException {
        var begun = new CountDownLatch(1);
        troop.space.execute(() -> {
            for (int client = 0; client < clients; client++) {
                troop.join();
            }
            begun.countDown();
        });
        if (troop.cranked) {
            troop.space.crank();
        }
        assertThat(begun.await(30, TimeUnit.SECONDS)).isTrue();
    }
}
