package io.troupe.actor;

import java.time.Duration;
import java.util.List;
import java.util.stream.Collectors;

/**
 * One message has occupied a space's thread for too long, and blocks all other actors of the space.
 *
 * {@snippet :
 * Consumer<Stall> onStall = stall -> log.add(stall.space() + ": " + stall.atLeast());
 * SpaceSettings settings = SpaceSettings.named("shop").withOnStall(Duration.ofMillis(200), onStall);
 * }
 *
 * @param space the name of the space
 * @param atLeast the duration so far
 * @param stack the current stack of the thread, innermost call first
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
