namespace LagSim.Motion;

/// <summary>A complex number: what turns and scales vectors of the plane across an axis.</summary>
internal readonly struct Rotor
{
    internal Rotor(double real, double imaginary)
    {
        Real = real;
        Imaginary = imaginary;
    }

    internal double Real { get; }

    internal double Imaginary { get; }

    public static Rotor operator +(in Rotor a, in Rotor b) => new(a.Real + b.Real, a.Imaginary + b.Imaginary);

    public static Rotor operator -(in Rotor a, in Rotor b) => new(a.Real - b.Real, a.Imaginary - b.Imaginary);

    public static Rotor operator *(in Rotor a, double s) => new(a.Real * s, a.Imaginary * s);

    public static Rotor operator *(in Rotor a, in Rotor b) =>
        new((a.Real * b.Real) - (a.Imaginary * b.Imaginary), (a.Real * b.Imaginary) + (a.Imaginary * b.Real));
}
