package io.troupe.services.component;

import io.troupe.bus.Operation;

/**
 * Control messages that every component interface answers: requests of kind {@link Operation.Kind#CONTROL} to the
 * component's address.
 */
public final class Control {
    /**
     * Starts the component.
     *
     * @param by the sender, for information
     */
    public record Invoke(String by) {}

    /**
     * Terminates the component.
     *
     * @param by the sender, for information
     * @param life the number of the life to terminate: if a later one runs, it goes on, since the message is late; 0 =
     *     whichever runs
     */
    public record Terminate(String by, long life) {
        /** Terminates whichever life runs. */
        public Terminate(String by) {
            this(by, 0);
        }
    }

    /**
     * Checks the component's health.
     *
     * @param by the sender, for information
     * @param life the number of the life to check: another one is reported as a problem; 0 = whichever runs
     */
    public record AskHealth(String by, long life) {
        /** Checks whichever life runs. */
        public AskHealth(String by) {
            this(by, 0);
        }
    }

    /**
     * Confirms a start or a termination.
     *
     * @param state the name of a {@link ComponentState}
     * @param life the number of the current or last life, counted from 1; 0 before the first
     */
    public record Done(String component, String state, long life) {}

    /**
     * The result of a health check.
     *
     * @param state the name of a {@link ComponentState}
     * @param problem the problem; empty if the component is healthy
     * @param life the number of the current or last life, counted from 1; 0 before the first
     */
    public record HealthReport(String component, String state, String problem, long life) {
        public boolean isHealthy() {
            return problem.isEmpty();
        }
    }

    public static final Operation<Invoke, Done> INVOKE =
            new Operation<>("component/invoke", Invoke.class, Done.class, Operation.Kind.CONTROL);
    public static final Operation<Terminate, Done> TERMINATE =
            new Operation<>("component/terminate", Terminate.class, Done.class, Operation.Kind.CONTROL);
    public static final Operation<AskHealth, HealthReport> HEALTH =
            new Operation<>("component/health", AskHealth.class, HealthReport.class, Operation.Kind.CONTROL);

    private Control() {}
}
