package io.troupe.broker;

import io.troupe.bus.Address;
import java.util.List;

/**
 * The registry's entry for one provider of a service. It can leave the process.
 *
 * {@snippet :
 * broker.require(Need.ofService("finder", "camera")).then(camera -> show(camera.provider()));
 * }
 *
 * @param service the name of the service; several providers may offer the same one
 * @param capabilities further keys for a lookup, for example {@code "drives"} or {@code "senses"}
 * @param provider the address of the provider
 */
public record ServiceRecord(String service, List<String> capabilities, Address provider, Health health) {
    public ServiceRecord {
        capabilities = List.copyOf(capabilities);
    }
}
