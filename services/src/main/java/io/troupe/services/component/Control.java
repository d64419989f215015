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
     */
    public record Terminate(String by) {}

    /**
     * Checks the component's health.
     *
     * @param by the sender, for information
     */
    public record AskHealth(String by) {}

    /**
     * Confirms a start or a termination.
     *
     * @param state the name of a {@link ComponentState}
     */
    public record Done(String component, String state) {}

    /**
     * The result of a health check.
     *
     * @param state the name of a {@link ComponentState}
     * @param problem the problem; empty if the component is healthy
     */
    public record HealthReport(String component, String state, String problem) {
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
