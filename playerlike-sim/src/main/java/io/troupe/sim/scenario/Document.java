package io.troupe.sim.scenario;

import java.util.List;
import java.util.Map;

/**
 * A file with everything it includes.
 *
 * @param root its properties and entities at the top level
 * @param macros the {@code define}s by name; each is the entity an instance starts from
 */
record Document(Entity root, Map<String, Entity> macros) {
    List<Entity> entities() {
        return root.children();
    }
}
