using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy.Engines;

/// <summary>A two-dimensional engine, for plane scenes.</summary>
internal abstract class FlatEngine : SteppedEngine
{
    public override string? Excludes(WorkScene scene) => scene.Flat(Vector3D.Zero, 0) is null ? "it is two-dimensional, and the scene is not" : null;

    /// <summary>Builds a world of the engine in the scene's plane.</summary>
    internal abstract class FlatRun(WorkScene work, double step) : Run(work, step)
    {
        /// <summary>Half the length of a wall, in metres: far beyond the reach of any body.</summary>
        private const double Half = 1000;

        public override Vector3D Position(int body) => Unflat(FlatPosition(body), body);

        public override Vector3D Velocity(int body) => Unflat(FlatVelocity(body), body) - Work.Unflat(0, 0, body);

        public override Vector3D Spin(int body) => new(0, 0, FlatSpin(body));

        protected abstract double FlatSpin(int body);

        protected abstract (double X, double Y) FlatPosition(int body);

        protected abstract (double X, double Y) FlatVelocity(int body);

        /// <summary>Returns the start of a body.</summary>
        protected (double X, double Y) FlatStart(int body) => Work.Flat(Scene.Bodies[body].Position, body)!.Value;

        /// <summary>Returns a direction in the scene's plane.</summary>
        protected (double X, double Y) FlatDirection(in Vector3D direction) => Work.FlatNormal(direction);

        /// <summary>
        /// Returns the ends of a long line at some depth behind a surface; null if the surface is the scene's plane itself.
        /// </summary>
        protected ((double X, double Y) From, (double X, double Y) To)? Line(StaticPlane plane, double behind)
        {
            (double x, double y) = Work.FlatNormal(plane.Normal);
            double at = plane.Offset - behind;
            return x == 0 && y == 0 ? null : (((x * at) - (y * Half), (y * at) + (x * Half)), ((x * at) + (y * Half), (y * at) - (x * Half)));
        }

        private Vector3D Unflat((double X, double Y) v, int body) => Work.Unflat(v.X, v.Y, body);
    }
}
