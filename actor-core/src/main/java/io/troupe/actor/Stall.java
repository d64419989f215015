package io.troupe.actor;

import java.time.Duration;
import java.util.List;
import java.util.stream.Collectors;

/**
 * One message has held a space's thread for too long; everybody else in the space waits meanwhile.
 *
 * {@snippet :
 * Consumer<Stall> onStall = stall -> log.add(stall.space() + ": " + stall.atLeast());
 * SpaceSettings settings = SpaceSettings.named("shop").withOnStall(Duration.ofMillis(200), onStall);
 * }
 *
 * @param space its name
 * @param atLeast how long it has taken so far
 * @param stack where the thread is now, innermost call first
 */
public record Stall(String space, Duration atLeast, List<StackTraceElement> stack) {
    public Stall {
        stack = List.copyOf(stack);
    }

    @Override
    public String toString() {
        return "space " + space + " has been busy with one message for " + atLeast.toMillis()
                + " ms; use offload(..) for work that blocks"
                + stack.stream()
                        .map(frame -> System.lineSeparator() + "\tat " + frame)
                        .collect(Collectors.joining());
    }
}
