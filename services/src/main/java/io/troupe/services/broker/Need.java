package io.troupe.services.broker;

import org.jspecify.annotations.Nullable;

/**
 * Who needs which service, by its name, by a capability, or by both.
 *
 * @param by for messages to people
 */
public record Need(
        String by, @Nullable String service, @Nullable String capability) {
    public Need {
        if (service == null && capability == null) {
            throw new IllegalArgumentException(by + " needs nothing: expected a service, a capability, or both");
        }
    }

    public static Need ofService(String by, String service) {
        return new Need(by, service, null);
    }

    public static Need ofCapability(String by, String capability) {
        return new Need(by, null, capability);
    }
}
