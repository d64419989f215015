package io.troupe.services.subsumption;

import java.util.List;

/**
 * Kinds of services from outside, for tables to name.
 *
 * <p><b>Role.</b> A provider of {@link java.util.ServiceLoader}: a public class with a constructor that takes nothing,
 * which its jar names in {@code META-INF/services/io.troupe.services.subsumption.ServiceKinds}. {@link ServiceJar}
 * finds it there.
 */
@FunctionalInterface
public interface ServiceKinds {
    /** The kinds; asked for once. Their names must differ from those of the catalogue and of other jars. */
    List<ServiceCatalogue.Kind> kinds();
}
