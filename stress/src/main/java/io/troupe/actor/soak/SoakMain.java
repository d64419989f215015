package io.troupe.actor.soak;

import java.util.List;

/**
 * The command line of the soak test. Its exit status is 0; 1 if a message was lost, out of order or retained; or 2 for
 * invalid arguments.
 */
public final class SoakMain {
    private SoakMain() {}

    public static void main(String[] arguments) throws InterruptedException {
        SoakOptions options;
        try {
            options = SoakOptions.parse(List.of(arguments));
        } catch (IllegalArgumentException | ArithmeticException wrong) {
            System.err.println("soak: " + wrong.getMessage());
            System.exit(2);
            return;
        }
        System.out.println("soak: " + options);
        var faults = new Soak(options, System.out::println).run();
        faults.stream().limit(20).forEach(fault -> System.out.println("VIOLATION " + fault));
        System.out.println(
                faults.isEmpty()
                        ? "soak: nothing lost, nothing out of order, memory flat"
                        : "soak: " + faults.size() + " violation(s)");
        System.exit(faults.isEmpty() ? 0 : 1);
    }
}
