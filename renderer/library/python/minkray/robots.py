# SPDX-License-Identifier: MIT
"""Objects of one file, with movable joints."""
import numpy as np

from .calls import Error, array_of, given_pose_of, public


class _Joints:
    """Joint values by name: assigning moves the robot at the next query."""

    def __init__(self, group, changed):
        self._group, self._changed = group, changed

    def set(self, name, value):
        """Sets the value of a joint."""
        names = self._group.joints
        if name not in names:
            raise Error(f"must be the name of a movable joint: {', '.join(names) or 'none'} "
                        f"(got {name!r})")
        numbers = array_of(value, name)
        if not np.isfinite(numbers).all():
            raise Error(f"{name}: must be finite (got {value})")
        self._group.set(name, np.atleast_1d(numbers))
        self._changed()

    def get(self, name):
        """Returns the value of a joint."""
        names = self._group.joints
        if name not in names:
            raise Error(f"must be the name of a movable joint: {', '.join(names) or 'none'} "
                        f"(got {name!r})")
        value = self._group.value(names.index(name))
        return float(value[0]) if len(value) == 1 else value

    def __setitem__(self, name, value):
        public(self.set, "Robot.joints")(name, value)

    def __getitem__(self, name):
        return public(self.get, "Robot.joints")(name)

    def __iter__(self):
        return iter(self._group.joints)

    def __len__(self):
        return len(self._group.joints)

    def __contains__(self, name):
        return name in self._group.joints

    def keys(self):
        return self._group.joints

    def values(self):
        return [self[name] for name in self]

    def items(self):
        return [(name, self[name]) for name in self]

    def __repr__(self):
        shown = ", ".join(f"{name}: {np.array2string(np.asarray(value), separator=', ')}"
                          for name, value in self.items())
        return f"<joints {shown}>"


class Robot:
    """Objects of one file.

    Attributes
    ----------
    objects : range
        Numbers of the objects.
    joint_names : list of str
    joints : mapping
        ``robot.joints["elbow"] = 0.4``, or ``robot.joints = {...}``, or an array in the order of
        `joint_names`: radians or lengths. ``robot.joints["elbow"]`` is its value.
    """

    def __init__(self, group, scene, changed):
        self._group, self._scene, self._changed = group, scene, changed
        self._joints = _Joints(group, changed)
        self.objects = range(group.first, group.first + group.size)

    @property
    def joint_names(self):
        """list of str : names of movable joints, in the file's order."""
        return self._group.joints

    @property
    def joints(self):
        """mapping : joint values by name (radians or lengths); assigning moves the robot."""
        return self._joints

    @joints.setter
    def joints(self, values):
        public(self._set_joints, "Robot.joints")(values)

    def _set_joints(self, values):
        names = self.joint_names
        if not hasattr(values, "items"):
            given = list(values) if hasattr(values, "__iter__") else None
            if given is None or len(given) != len(names):
                raise Error(f"must be {len(names)} values, of {', '.join(names) or 'no joints'} "
                            f"(got {values!r})")
            values = given
            values = dict(zip(names, values))
        unknown = [name for name in values.keys() if name not in names]
        if unknown:
            raise Error(f"must be names of movable joints: {', '.join(names) or 'none'} "
                        f"(got {unknown[0]!r})")
        for name, value in values.items():
            self._joints.set(name, value)

    @public
    def set_pose(self, pose):
        """Moves all objects of the file.

        Parameters
        ----------
        pose : (4, 4) or (7,) array
            From the file's frame to the world.
        """
        self._group.set_pose(given_pose_of(pose))
        self._changed()

    def __repr__(self):
        return f"<minkray.Robot of {len(self.objects)} objects, {len(self.joint_names)} joints>"


def robot_of(value, scene):
    """The value, which must be a Robot of the scene."""
    if not isinstance(value, Robot) or value._scene is not scene:
        raise Error("robot: must be a Robot of this scene")
    return value
