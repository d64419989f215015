package io.troupe.actor;

import io.troupe.actor.time.Clock;
import java.util.Objects;
import java.util.function.Consumer;

/**
 * How an actor space is made; immutable.
 *
 * @param name of the space and its thread
 * @param clock by which timers run
 * @param onError is told what nobody else could be told
 * @param onDeadLetter is told of messages that reached nobody, on whichever thread found out
 * @param handCranked true for a space without a thread of its own, which only {@link ActorSpace#crank} moves
 */
public record SpaceSettings(
        String name, Clock clock, ErrorHandler onError, Consumer<DeadLetter> onDeadLetter, boolean handCranked) {
    public SpaceSettings {
        Objects.requireNonNull(name, "name");
        Objects.requireNonNull(clock, "clock");
        Objects.requireNonNull(onError, "onError");
        Objects.requireNonNull(onDeadLetter, "onDeadLetter");
    }

    /** A daemon thread on the machine's clock that logs what goes wrong. */
    public static SpaceSettings named(String name) {
        var log = System.getLogger(ActorSpace.class.getName());
        return new SpaceSettings(
                name,
                Clock.system(),
                (where, error) -> log.log(System.Logger.Level.ERROR, "in " + where, error),
                letter -> log.log(System.Logger.Level.WARNING, "dead letter: " + letter),
                false);
    }

    public SpaceSettings withClock(Clock newClock) {
        return new SpaceSettings(name, newClock, onError, onDeadLetter, handCranked);
    }

    public SpaceSettings withOnError(ErrorHandler handler) {
        return new SpaceSettings(name, clock, handler, onDeadLetter, handCranked);
    }

    public SpaceSettings withOnDeadLetter(Consumer<DeadLetter> handler) {
        return new SpaceSettings(name, clock, onError, handler, handCranked);
    }

    public SpaceSettings withHandCrank() {
        return new SpaceSettings(name, clock, onError, onDeadLetter, true);
    }
}
