package io.troupe.actor.race;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Clock;
import java.util.EnumMap;
import java.util.Random;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

/**
 * Real threads and real spaces in random rounds, each of one {@link Scenario}: promises, calls, ends, bounds, chains,
 * streams, timers and errors. The number of calls sent must equal those handled, rejected and dropped. At the end of a
 * round every space is closed and its threads have ended.
 *
 * <p>Every build runs each scenario a few times. {@code -Dsoak.minutes=10} runs for that long, {@code -Dsoak.first=17}
 * begins with that round, and {@code -Dsoak.seed=17} runs that round alone. The seed does not schedule the threads, so
 * a round may have to be repeated to fail again: {@code -Dsoak.seed=17 -Dsoak.minutes=1} repeats it for a minute.
 */
@Tag("threads")
class ActorSoakTest {
    private static final int ROUNDS_OF_EACH = 2;

    /** The subject of a round. */
    enum Scenario {
        PROMISES(PromiseRaces::listeners),
        CALLS_AND_CLOSE(round -> new CallRaces(round, "closed").close()),
        CALLS_AND_RESTART(round -> new CallRaces(round, "restarting").restart()),
        BOUNDED_MAILBOXES(round -> new CallRaces(round, "bounded").bounds()),
        ASKS_AFTER_SILENCE(round -> new ChainRaces(round).silence()),
        CHAINS_AND_BODIES(round -> new ChainRaces(round).chains()),
        TOPICS_AND_STREAMS(StreamRaces::play),
        TIME_LIMITS(PromiseRaces::timeLimits),
        SHARED_LIMITS(DeliveryRaces::sharedLimits),
        HELD_AND_POOLED(DeliveryRaces::heldAndPooled),
        STOPPING_POOL(PoolRaces::stoppingMembers),
        NEWEST_ONLY(DeliveryRaces::newestOnly),
        END_OF_THE_STACK(ErrorRaces::endOfTheStack),
        FATAL_ERRORS(ErrorRaces::fatalErrors);

        /** Runs a round. */
        interface Play {
            void accept(Round round) throws Exception;
        }

        private final Play play;

        Scenario(Play play) {
            this.play = play;
        }
    }

    @Test
    void randomRounds_addUp_andLeaveNoThread() {
        Long only = Long.getLong("soak.seed");
        Long given = Long.getLong("soak.first");
        long first = only != null ? only : given != null ? given : new Random().nextInt(1_000_000_000);
        int atLeast = only != null ? 1 : ROUNDS_OF_EACH * Scenario.values().length;
        long endNanos = Clock.system().nanos() + Long.getLong("soak.minutes", 0L) * 60_000_000_000L;
        var rounds = new EnumMap<Scenario, Integer>(Scenario.class);
        for (long i = 0; i < atLeast || endNanos - Clock.system().nanos() > 0; i++) {
            long seed = only != null ? only : first + i;
            rounds.merge(run(seed), 1, Integer::sum);
        }
        System.getLogger("soak").log(System.Logger.Level.INFO, "rounds: " + rounds);
        if (only == null) {
            assertThat(rounds).hasSize(Scenario.values().length);
        }
    }

    /** The scenarios alternate, so that a few consecutive rounds cover all of them. */
    private static Scenario run(long seed) {
        var scenario = Scenario.values()[(int) Math.floorMod(seed, (long) Scenario.values().length)];
        try (var round = new Round(seed)) {
            scenario.play.accept(round);
        } catch (Exception | Error failure) {
            throw new AssertionError("-Dsoak.seed=" + seed + " (" + scenario + "): " + failure.getMessage(), failure);
        }
        return scenario;
    }
}
