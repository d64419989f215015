package io.troupe.services.broker;

import io.troupe.services.bus.Address;
import java.util.List;

/**
 * What the registry says of one provider of a service. It can leave the process.
 *
 * @param service the service's name; several providers may offer the same one
 * @param capabilities what else it can be found by, for example {@code "drives"} or {@code "senses"}
 * @param provider where it is
 */
public record ServiceRecord(String service, List<String> capabilities, Address provider, Health health) {
    public ServiceRecord {
        capabilities = List.copyOf(capabilities);
    }
}
