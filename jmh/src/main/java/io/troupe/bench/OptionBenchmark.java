package io.troupe.bench;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.CallGraph;
import io.troupe.actor.CallObserver;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.TurnContext;
import java.time.Duration;
import java.util.Objects;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;
import org.jspecify.annotations.Nullable;
import org.openjdk.jmh.annotations.Benchmark;
import org.openjdk.jmh.annotations.BenchmarkMode;
import org.openjdk.jmh.annotations.Fork;
import org.openjdk.jmh.annotations.Measurement;
import org.openjdk.jmh.annotations.Mode;
import org.openjdk.jmh.annotations.OperationsPerInvocation;
import org.openjdk.jmh.annotations.OutputTimeUnit;
import org.openjdk.jmh.annotations.Param;
import org.openjdk.jmh.annotations.Scope;
import org.openjdk.jmh.annotations.Setup;
import org.openjdk.jmh.annotations.State;
import org.openjdk.jmh.annotations.Warmup;

/**
 * What the options of a space cost: a message between two actors and a question with its listener, in a space with one
 * option each. {@code NONE} is a space without options.
 */
@State(Scope.Benchmark)
@BenchmarkMode(Mode.AverageTime)
@OutputTimeUnit(TimeUnit.NANOSECONDS)
@Fork(3)
@Warmup(iterations = 4, time = 500, timeUnit = TimeUnit.MILLISECONDS)
@Measurement(iterations = 5, time = 500, timeUnit = TimeUnit.MILLISECONDS)
public class OptionBenchmark {
    private static final int MESSAGES = 20_000;
    private static final Duration LONG = Duration.ofSeconds(30);

    /** What is set. */
    public enum Option {
        NONE,
        /** A context of callers that have none. */
        CONTEXT_OF_NO_CALLER,
        CONTEXT,
        /** An observer that does nothing. */
        CALL_OBSERVER,
        CALL_GRAPH,
        ACTOR_QUOTA,
        /** Each question in {@link ActorSpace#within}; messages have no limit. */
        WITHIN
    }

    /** Hits the ball back, and answers questions. */
    public interface Player {
        void meet(Player newPartner);

        void ping(int hops);

        Promise<Integer> sum();

        /** Asks the partner so many times, one after the other. */
        void askInTurn(int times);
    }

    private static final class PlainPlayer implements Player {
        private final Consumer<Integer> listener = this::onAnswer; // made once, so that all bytes are the library's
        private final ActorSpace space;
        private final boolean isLimited;
        private @Nullable Player partner;
        private int left;

        PlainPlayer(ActorSpace space, boolean isLimited) {
            this.space = space;
            this.isLimited = isLimited;
        }

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

        @Override
        public Promise<Integer> sum() {
            return Promise.of(1);
        }

        @Override
        public void askInTurn(int times) {
            left = times;
            ask();
        }

        private void ask() {
            Player asked = Objects.requireNonNull(partner);
            Promise<Integer> answer = isLimited ? space.within(LONG, asked::sum) : asked.sum();
            answer.then(listener);
        }

        private void onAnswer(int answer) {
            left -= answer;
            if (left > 0) {
                ask();
            }
        }
    }

    /** The name of the user of a thread, as logging libraries keep it. */
    private static final class UserContext implements TurnContext<String> {
        private final ThreadLocal<@Nullable String> user = new ThreadLocal<>();

        @Override
        public @Nullable String capture() {
            return user.get();
        }

        @Override
        public Runnable restore(String captured) {
            user.set(captured);
            return user::remove;
        }
    }

    @Param
    private Option option;

    private final UserContext context = new UserContext();
    private ActorSpace space;
    private Player player;

    @Setup
    public void open() {
        SpaceSettings plain = SpaceSettings.named("options").withoutThread();
        SpaceSettings settings = switch (option) {
            case NONE, WITHIN -> plain;
            case CONTEXT_OF_NO_CALLER, CONTEXT -> plain.withContext(context);
            case CALL_OBSERVER -> plain.withCallObserver(new CallObserver() {});
            case CALL_GRAPH -> plain.withCallObserver(new CallGraph());
            case ACTOR_QUOTA -> plain.withActorQuota(16);
        };
        space = ActorSpace.create(settings);
        player = spawn();
        Player other = spawn();
        player.meet(other);
        other.meet(player);
    }

    private Player spawn() {
        return space.spawn(Player.class, () -> new PlainPlayer(space, option == Option.WITHIN));
    }

    /** Of this thread, which runs the space; the turns before have removed it. */
    private void setUser() {
        if (option == Option.CONTEXT) {
            context.user.set("alice");
        }
    }

    @Benchmark
    @OperationsPerInvocation(MESSAGES)
    public void message() {
        setUser();
        player.ping(MESSAGES);
        space.runQueued();
    }

    @Benchmark
    @OperationsPerInvocation(MESSAGES)
    public void question() {
        setUser();
        player.askInTurn(MESSAGES);
        space.runQueued();
    }
}
