package io.troupe.bench;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import java.util.Objects;
import java.util.concurrent.TimeUnit;
import org.jspecify.annotations.Nullable;
import org.openjdk.jmh.annotations.Benchmark;
import org.openjdk.jmh.annotations.BenchmarkMode;
import org.openjdk.jmh.annotations.Fork;
import org.openjdk.jmh.annotations.Measurement;
import org.openjdk.jmh.annotations.Mode;
import org.openjdk.jmh.annotations.OperationsPerInvocation;
import org.openjdk.jmh.annotations.OutputTimeUnit;
import org.openjdk.jmh.annotations.Scope;
import org.openjdk.jmh.annotations.Setup;
import org.openjdk.jmh.annotations.State;
import org.openjdk.jmh.annotations.Warmup;

/**
 * Shows where the time of a message between two actors of one thread goes. The floor is a ring of message objects and
 * one virtual call for each, without actors, owners, failures and other threads. Any implementation with more than one
 * class of message objects needs at least this time.
 */
@State(Scope.Benchmark)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(3)
@Warmup(iterations = 4, time = 500, timeUnit = TimeUnit.MILLISECONDS)
@Measurement(iterations = 5, time = 500, timeUnit = TimeUnit.MILLISECONDS)
public class HopBenchmark {
    private static final int HOPS = 20_000;

    /** Hits the ball back. */
    public interface Player {
        void meet(Player newPartner);

        void ping(int hops);
    }

    private static final class PlainPlayer implements Player {
        private @Nullable Player partner;

        @Override
        public void meet(Player newPartner) {
            partner = newPartner;
        }

        @Override
        public void ping(int hops) {
            if (hops > 0) {
                Objects.requireNonNull(partner).ping(hops - 1);
            }
        }
    }

    private abstract static class Entry {
        abstract void run();
    }

    /** The message. */
    private static final class Ping extends Entry {
        private final Player player;
        private final int hops;

        Ping(Player player, int hops) {
            this.player = player;
            this.hops = hops;
        }

        @Override
        void run() {
            player.ping(hops);
        }
    }

    /** A further class of messages, so that the call is virtual. */
    private static final class Meet extends Entry {
        private final Player player;
        private final Player partner;

        Meet(Player player, Player partner) {
            this.player = player;
            this.partner = partner;
        }

        @Override
        void run() {
            player.meet(partner);
        }
    }

    private static final class Nothing extends Entry {
        @Override
        void run() {}
    }

    /** The counterpart of a proxy. */
    private record Sender(Ring ring, Player player) implements Player {
        @Override
        public void meet(Player newPartner) {
            ring.add(new Meet(player, newPartner));
        }

        @Override
        public void ping(int hops) {
            ring.add(new Ping(player, hops));
        }
    }

    private static final class Ring {
        private @Nullable Entry[] entries = new Entry[256];
        private int head;
        private int tail;

        void add(Entry entry) {
            entries[tail++ & (entries.length - 1)] = entry;
        }

        void drain() {
            while (head != tail) {
                int place = head++ & (entries.length - 1);
                Entry entry = Objects.requireNonNull(entries[place]);
                entries[place] = null;
                entry.run();
            }
        }

        /** Replaces the array: stores into an old array, which the collector has promoted, are slower. */
        void renew() {
            entries = new Entry[256];
            head = 0;
            tail = 0;
        }
    }

    private final Ring ring = new Ring();
    private final Player floorPlayer = new Sender(ring, new PlainPlayer());
    private ActorSpace space;
    private Player actor;

    @Setup
    public void open() {
        Player other = new Sender(ring, new PlainPlayer());
        floorPlayer.meet(other);
        other.meet(floorPlayer);
        for (int times = 0; times < 50_000; times++) { // three classes of entries, before anything is compiled
            ring.add(new Nothing());
            other.meet(floorPlayer);
            floorPlayer.ping(0);
            ring.drain();
        }
        space = ActorSpace.create(SpaceSettings.named("hop").withoutThread());
        actor = space.spawn(Player.class, PlainPlayer::new);
        Player otherActor = space.spawn(Player.class, PlainPlayer::new);
        actor.meet(otherActor);
        otherActor.meet(actor);
    }

    @Benchmark
    @OperationsPerInvocation(HOPS)
    public void hop_floor() {
        ring.renew();
        floorPlayer.ping(HOPS);
        ring.drain();
    }

    @Benchmark
    @OperationsPerInvocation(HOPS)
    public void hop_troupe() {
        actor.ping(HOPS);
        space.runQueued();
    }
}
