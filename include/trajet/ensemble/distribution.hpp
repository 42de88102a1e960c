#pragma once

namespace trajet {

/// How a quantity is spread. Numbers are drawn by the quantile function, so that each is a monotonic function of one
/// number between 0 and 1, whatever design that number comes from.
class Distribution {
 public:
  static Distribution normal(double mean, double deviation);
  static Distribution uniform(double low, double high);
  /// Of a positive quantity with that mean and standard deviation, both of the quantity itself, whose logarithm is
  /// normal.
  static Distribution lognormal(double mean, double deviation);
  /// A normal one of which only what lies between `low` and `high` occurs; mean and deviation are those before the cut.
  static Distribution truncated(double mean, double deviation, double low, double high);

  /// The value below which the share `u` lies, 0 < u < 1.
  double quantile(double u) const;

 private:
  enum class Kind { normal, uniform, lognormal, truncated };
  Distribution(Kind kind, double a, double b) : kind_(kind), a_(a), b_(b) {}

  Kind kind_;
  double a_, b_;                          // mean and deviation, of the logarithm for a lognormal one; or the limits
  double low_share_ = 0.0, share_ = 1.0;  // of the normal distribution: below the lower limit, and between both
  double low_ = 0.0, high_ = 0.0;         // of a truncated one
  bool is_upper_ = false;                 // shares are counted from above, where they have more digits
};

/// The value of the standard normal distribution below which the share `u` lies.
double normal_quantile(double u);
/// The share of the standard normal distribution that lies below `z`.
double normal_share(double z);

}  // namespace trajet
