package io.troupe.services.subsumption;

import java.util.List;

/**
 * A provider of additional kinds of services for tables.
 *
 * <p><b>Role.</b> A provider for {@link java.util.ServiceLoader}: a public class with a constructor without parameters,
 * listed in its jar in {@code META-INF/services/io.troupe.services.subsumption.ServiceKinds}. {@link ServiceJar} loads
 * it.
 */
@FunctionalInterface
public interface ServiceKinds {
    /** Returns the kinds; called once. Their names must differ from those of the catalogue and of other jars. */
    List<ServiceCatalogue.Kind> kinds();
}
