package io.troupe.services.component;

import io.troupe.services.bus.Operation;

/**
 * The control messages that every interface answers: questions of the control kind, asked of the component's address.
 */
public final class Control {
    /** Start. */
    public record Invoke(String by) {}

    /** End. */
    public record Terminate(String by) {}

    /** How are you? */
    public record AskHealth(String by) {}

    /** It is done. */
    public record Done(String component, String state) {}

    /**
     * How a component is.
     *
     * @param state the name of a {@link Lifecycle}
     * @param problem what is wrong; empty if it is well
     */
    public record HealthReport(String component, String state, String problem) {
        public boolean isWell() {
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
