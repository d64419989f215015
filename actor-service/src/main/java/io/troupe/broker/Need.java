package io.troupe.broker;

import org.jspecify.annotations.Nullable;

/**
 * A client's requirement: the service it looks up, by name, by capability, or by both.
 *
 * {@snippet :
 * broker.find(Need.ofCapability("finder", "colour")).then(cameras -> show(cameras.size()));
 * broker.require(Need.ofService("finder", "camera")).then(camera -> show(camera.provider()));
 * }
 *
 * @param by the name of the client, for messages
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
